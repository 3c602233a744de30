#include "cairn/localization/pose_belief.hpp"

#include "monte_carlo_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::kStart;
using test::on_circle;

constexpr std::uint32_t kFirstRival = 1'000'000;

/// How the parts of the belief work together: search, monitor, recovery.
class PoseBeliefTest : public test::MonteCarloLocalizerTest {
 protected:
  double error_at_the_end(const Pose2& start) const {
    const Estimate& last = estimates_.back();
    return distance(last.T_map_base, on_circle(start, to_seconds(last.stamp)));
  }
  // On a circle, and after 5 s on another one.
  void carry_away() { drive_to_and_on(5.0); }
  void drive_to_and_on(double carried_at) {
    for (int i = 0; i < 400; ++i) {
      const double seconds = 0.05 * i;
      const bool carried = seconds > carried_at;
      odometry(seconds);
      if (i % 4 != 0) continue;
      const Pose2 truth = on_circle(carried ? kElsewhere : kStart, seconds + 0.013);
      localizer_->process(test::scan_event(test::scan_from(map_, truth, at(seconds + 0.013))));
      const HypothesisSnapshot known = localizer_->hypotheses();
      const bool has_rivals = std::any_of(known.hypotheses.begin(), known.hypotheses.end(),
                                          [](const Hypothesis& h) { return h.id >= kFirstRival; });
      (carried ? rivals_after_ : rivals_before_) |= has_rivals;
    }
    localizer_->finish();
  }
  // Ten scans in two seconds; `look(seconds)` gives those of the second scanner.
  template <class Look>
  void with_second_scanner(double until, const Look& look, const LocalizerOptions& options = {}) {
    streams_.push_back(streams_[1]);
    streams_.back().name = "second";
    make(options);
    for (int i = 0; 0.05 * i < until; ++i) {
      odometry(0.05 * i);
      if (i % 4 == 0) localizer_->process(test::scan_event(look(0.05 * i + 0.013), 2));
    }
    localizer_->finish();
  }
  LaserScan above_the_walls(const Pose2& truth, double seconds) const {
    LaserScan high = test::scan_from(map_, truth, at(seconds + 0.007));
    for (std::size_t k = 0; k < high.ranges_m.size() / 2; ++k) high.ranges_m[k] *= 1.7f;
    return high;
  }
  static bool claims_to_know(const Estimate& e) {
    return e.judgement.state == TrackingState::kTracking || e.judgement.state == TrackingState::kCrowded;
  }

  const Pose2 kElsewhere = kStart * Pose2{1.5, 1.0, 2.0};
  bool rivals_before_ = false, rivals_after_ = false;
};

// Every second the robot has a new look; the eighth comes after seven seconds.
TEST_F(PoseBeliefTest, ARobotThatMayBeAnywhereClaimsLittleUntilASearchConfirmsIt) {
  LocalizerOptions options;
  options.filter.min_particles = 1000;
  options.global.most_poses = 20;
  make(options, {});
  drive(20.0);
  for (const Estimate& e : estimates_) {
    if (e.stamp > at(6.5)) break;
    EXPECT_LE(e.judgement.probability, 0.9) << to_seconds(e.stamp);
    EXPECT_FALSE(claims_to_know(e)) << to_seconds(e.stamp);
  }
  EXPECT_GT(estimates_.back().judgement.probability, 0.9);
  EXPECT_TRUE(claims_to_know(estimates_.back()));
  EXPECT_LT(error_at_the_end(kStart), 0.15);
}

TEST_F(PoseBeliefTest, ARobotThatIsCarriedAwayHasRivalsAndIsFoundAgain) {
  make(LocalizerOptions{});
  carry_away();
  EXPECT_FALSE(rivals_before_);
  EXPECT_TRUE(rivals_after_);
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
  EXPECT_TRUE(claims_to_know(estimates_.back()));
}

// Carried away before the search has confirmed anything: the search does not touch the particles, so that
// recovery must work beside it.
TEST_F(PoseBeliefTest, ARobotThatIsStillBeingLookedForIsRecoveredToo) {
  make(LocalizerOptions{}, {});
  carry_away();
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

// Its search says what is known; a place that took over meanwhile is not doubted any longer than that.
TEST_F(PoseBeliefTest, NothingIsLeftUnsettledBesideTheSearch) {
  LocalizerOptions options;
  options.recovery.settle_m = 1000.0;
  make(options, {});
  carry_away();
  EXPECT_GT(estimates_.back().judgement.probability, 0.9);
}

TEST_F(PoseBeliefTest, ThePlaceThatTakesOverIsJudgedByTheSameScan) {
  make(LocalizerOptions{});
  carry_away();
  const auto found = std::find_if(estimates_.begin(), estimates_.end(), [&](const Estimate& e) {
    return e.stamp > at(5.0) && distance(e.T_map_base, on_circle(kElsewhere, to_seconds(e.stamp))) < 0.5;
  });
  ASSERT_NE(found, estimates_.end());
  EXPECT_GT(found->judgement.explained, 0.8);
  EXPECT_GT(found->judgement.probability, 0.75);
}

TEST_F(PoseBeliefTest, ItIsNotSureOfItBeforeItIsSettled) {
  make(LocalizerOptions{});
  carry_away();
  EXPECT_GT(estimates_.back().judgement.probability, 0.95);
  LocalizerOptions never;
  never.recovery.settle_m = 1000.0;
  make(never);
  carry_away();
  for (const Estimate& e : estimates_) {
    if (e.stamp > at(5.1)) {
      EXPECT_LE(e.judgement.probability, 0.9);
    }
  }
}

// A person before a camera fills its view: that is no kidnapping, as long as a laser sees that nothing has
// moved.
TEST_F(PoseBeliefTest, ACameraDoesNotTellThatTheRobotWasCarriedAway) {
  with_second_scanner(5.0, [&](double seconds) {
    scan(seconds);
    LaserScan narrow = test::scan_from(map_, on_circle(kStart, seconds + 0.007), at(seconds + 0.007), 360);
    narrow.ranges_m.resize(60);
    if (std::abs(seconds - 3.013) < 1e-6) std::fill(narrow.ranges_m.begin(), narrow.ranges_m.end(), 0.5f);
    return narrow;
  });
  for (const Estimate& e : estimates_) {
    if (e.stamp > at(1.0)) {
      EXPECT_GT(e.judgement.probability, 0.9) << to_seconds(e.stamp);
    }
  }
}

// With a camera alone nothing says that the robot was not: it is doubted by what the map explains.
TEST_F(PoseBeliefTest, ACameraAloneKeepsNoPose) {
  make(LocalizerOptions{});
  for (int i = 0; i < 300; ++i) {
    const double seconds = 0.05 * i;
    odometry(seconds);
    if (i % 4 != 0) continue;
    const Pose2 truth = on_circle(seconds > 5.0 ? kElsewhere : kStart, seconds + 0.013);
    LaserScan narrow = test::scan_from(map_, truth, at(seconds + 0.013), 360);
    narrow.ranges_m.resize(100);
    localizer_->process(test::scan_event(std::move(narrow)));
    const HypothesisSnapshot known = localizer_->hypotheses();
    // Within a metre of the way: an anchored pose would have none.
    if (seconds > 5.0 && seconds < 6.0)
      rivals_after_ |= std::any_of(known.hypotheses.begin(), known.hypotheses.end(),
                                   [](const Hypothesis& h) { return h.id >= kFirstRival; });
  }
  EXPECT_TRUE(rivals_after_);
}

// Its beams pass through walls wherever the robot is: it is mounted higher than what was mapped, say.
TEST_F(PoseBeliefTest, AScannerThatTheMapDoesNotFitDoesNotDoubtWhatAnotherOneSees) {
  with_second_scanner(20.0, [&](double seconds) {
    scan(seconds);
    return above_the_walls(on_circle(kStart, seconds), seconds);
  });
  for (const Estimate& e : estimates_) {
    EXPECT_LT(distance(e.T_map_base, on_circle(kStart, to_seconds(e.stamp))), 0.3) << to_seconds(e.stamp);
    EXPECT_TRUE(claims_to_know(e)) << to_seconds(e.stamp);
  }
}

// Both doubt at once, and each is looked for from its own mount.
TEST_F(PoseBeliefTest, ARobotWithScannersToBothSidesIsFoundAgain) {
  const Pose2 T_base_rear{-0.3, 0.0, 2.5};
  streams_.push_back({"rear", StreamKind::kLaserScan, "", T_base_rear});
  make(LocalizerOptions{});
  for (int i = 0; i < 140; ++i) {
    const double seconds = 0.05 * i;
    odometry(seconds);
    if (i % 4 != 0) continue;
    const Pose2& start = seconds > 5.0 ? kElsewhere : kStart;
    localizer_->process(
        test::scan_event(test::scan_from(map_, on_circle(start, seconds + 0.013), at(seconds + 0.013))));
    const Pose2 rear = on_circle(start, seconds + 0.02) * T_base_rear;
    localizer_->process(test::scan_event(test::scan_from(map_, rear, at(seconds + 0.02)), 2));
  }
  localizer_->finish();
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

// From 10 s on it sees a part of the room that was never mapped.
TEST_F(PoseBeliefTest, ARobotThatSeesWhatIsNotMappedIsNotLost) {
  const OccupancyGrid whole = map_;
  const GridGeometry& grid = whole.geometry();
  auto cells = whole.cells();
  for (int row = 0; row < grid.height; ++row) {
    for (int column = grid.width / 2; column < grid.width; ++column)
      cells[grid.index(column, row)] = OccupancyGrid::kUnknown;
  }
  map_ = OccupancyGrid(grid, std::move(cells));
  make(LocalizerOptions{});
  for (int i = 0; i < 600; ++i) {
    const double seconds = 0.05 * i;
    odometry(seconds);
    if (i % 4 != 0) continue;
    const Pose2 truth = on_circle(kStart, seconds + 0.013);
    LaserScan seen = test::scan_from(whole, truth, at(seconds + 0.013));
    for (std::size_t k = 0; k < seen.ranges_m.size(); ++k) {
      const double bearing = seen.angle_min_rad + static_cast<double>(k) * seen.angle_increment_rad;
      const Point2 end =
          truth * Point2{seen.ranges_m[k] * std::cos(bearing), seen.ranges_m[k] * std::sin(bearing)};
      if (seconds < 10.0 && end.x > 4.0) seen.ranges_m[k] = 0.0f;
    }
    localizer_->process(test::scan_event(std::move(seen)));
  }
  localizer_->finish();
  for (const Estimate& e : estimates_) {
    EXPECT_LT(distance(e.T_map_base, on_circle(kStart, to_seconds(e.stamp))), 0.3) << to_seconds(e.stamp);
    EXPECT_TRUE(claims_to_know(e)) << to_seconds(e.stamp);
  }
}

// The map has taken it to where it is; but that it was told to begin elsewhere speaks against that for a
// while.
TEST_F(PoseBeliefTest, APoseThatTheMapHasMovedFarIsDoubted) {
  make(LocalizerOptions{}, {kStart * Pose2{-0.9, 0.0, 0.0}});
  drive(40.0);
  const Estimate& early = estimates_[2];
  EXPECT_LT(distance(early.T_map_base, on_circle(kStart, to_seconds(early.stamp))), 0.2);
  EXPECT_NEAR(early.judgement.drift, 0.9, 0.25);
  EXPECT_LT(early.judgement.probability, 0.5);
  EXPECT_EQ(early.judgement.state, TrackingState::kAmbiguous);
  EXPECT_LT(estimates_.back().judgement.drift, 0.2);
  EXPECT_TRUE(claims_to_know(estimates_.back()));
}

// What fits where it was drawn to may fit elsewhere better: the map has the less to say.
TEST_F(PoseBeliefTest, ARobotThatTheMapHasMovedIsNotLookedForElsewhere) {
  make(LocalizerOptions{}, {kStart * Pose2{-0.9, 0.0, 0.0}});
  drive_to_and_on(1e9);
  EXPECT_FALSE(rivals_before_);
  EXPECT_LT(error_at_the_end(kStart), 0.15);
}

TEST_F(PoseBeliefTest, AStartThatIsNotWellKnownIsNotHeldAgainstThePose) {
  LocalizerOptions options;
  options.initial.sigma_x_m = options.initial.sigma_y_m = 0.5;
  make(options, {kStart * Pose2{-0.9, 0.0, 0.0}});
  drive(5.0);
  EXPECT_LT(estimates_[2].judgement.drift, 0.2);
  EXPECT_TRUE(claims_to_know(estimates_[2]));
}

// A fifth more than the robot drives.
TEST_F(PoseBeliefTest, OdometryThatErrsIsNotHeldAgainstThePose) {
  make(LocalizerOptions{});
  for (int i = 0; i < 800; ++i) {
    const double seconds = 0.05 * i;
    const Pose2 way = on_circle({}, seconds);
    localizer_->process(test::odometry_event(seconds, {1.2 * way.x, 1.2 * way.y, way.theta}));
    if (i % 4 == 0) scan(seconds + 0.013);
  }
  localizer_->finish();
  for (const Estimate& e : estimates_) {
    EXPECT_LT(e.judgement.drift, 0.4) << to_seconds(e.stamp);
    EXPECT_TRUE(claims_to_know(e)) << to_seconds(e.stamp);
  }
}

TEST_F(PoseBeliefTest, NoEvidenceNeedBeAddedWhereTheMonitorDoubts) {
  LocalizerOptions options;
  options.recovery.sure = 1000.0;
  make(options);
  carry_away();
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

TEST_F(PoseBeliefTest, BeamsThroughWallsAreEnoughWhereTheMonitorDoesNotDoubt) {
  LocalizerOptions options;
  options.recovery.sure = 1000.0;
  options.recovery.doubt = 0.0;
  make(options);
  carry_away();
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

// One scan fits well at some place of any map: with that alone the pose is doubtful, but nobody is lost.
TEST_F(PoseBeliefTest, ATrustedPoseIsCalledAmbiguousByItsRivals) {
  LocalizerOptions options;
  options.recovery.refuted = 2.0;
  make(options);
  carry_away();
  const auto doubted = std::find_if(estimates_.begin(), estimates_.end(), [](const Estimate& e) {
    return e.stamp > at(5.0) && e.judgement.probability < 0.5;
  });
  ASSERT_NE(doubted, estimates_.end());
  EXPECT_EQ(doubted->judgement.state, TrackingState::kAmbiguous);
}

// Neither the monitor nor the map says anything: the scans alone do not go on where they left off.
TEST_F(PoseBeliefTest, AScanThatDoesNotGoOnIsEnough) {
  LocalizerOptions options;
  options.recovery.doubt = 0.0;
  options.recovery.drop = 1.0;
  options.recovery.surprise = 0.0;
  options.recovery.refuted = 2.0;
  make(options);
  carry_away();
  EXPECT_FALSE(rivals_before_);
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

LocalizerOptions never_doubting() {
  LocalizerOptions options;
  options.recovery.continued = 0.0;  // nor where a scan does not go on
  options.recovery.sure = 1000.0;
  options.recovery.doubt = 0.0;
  options.recovery.refuted = 2.0;  // not even by beams through walls
  return options;
}

TEST_F(PoseBeliefTest, NoRivalTakesOverFromAMonitorThatNeverDoubts) {
  make(never_doubting());
  carry_away();
  EXPECT_TRUE(rivals_after_);
  EXPECT_GT(error_at_the_end(kElsewhere), 0.5);
}

// What no search has confirmed need not be doubted.
TEST_F(PoseBeliefTest, ARivalTakesOverWhileTheRobotIsStillBeingLookedFor) {
  make(never_doubting(), {});
  carry_away();
  EXPECT_TRUE(rivals_after_);
  EXPECT_LT(error_at_the_end(kElsewhere), 0.15);
}

}  // namespace
}  // namespace cairn
