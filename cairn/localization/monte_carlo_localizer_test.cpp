#include "cairn/localization/monte_carlo_localizer.hpp"

#include "cairn/core/errors.hpp"
#include "every_sensor.hpp"
#include "small_room.hpp"

#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::odometry_event;
using test::on_circle;
using test::scan_event;
using test::scan_from;
using ::testing::HasSubstr;

const Pose2 kStart{2.0, 1.5, 0.0};

LocalizerOptions few_particles() {
  LocalizerOptions options;
  options.recipe = "mcl";
  options.filter.particles = 300;
  return options;
}

class MonteCarloLocalizerTest : public ::testing::Test {
 protected:
  void make(const LocalizerOptions& options = few_particles(), const Start& start = {kStart}, int threads = 1,
            std::uint64_t seed = 1) {
    estimates_.clear();
    localizer_ = std::make_unique<MonteCarloLocalizer>(options, streams_, map_, start, seed,
                                                       std::make_shared<const Executor>(threads));
    localizer_->set_observer([this](const Estimate& e) { estimates_.push_back(e); });
  }

  std::string refusal(const LocalizerOptions& options, const Start& start = {kStart}) {
    try {
      make(options, start);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  }

  Outcome odometry(double seconds) {
    return localizer_->process(odometry_event(seconds, on_circle({}, seconds)));
  }
  Outcome scan(double seconds) {
    return localizer_->process(scan_event(scan_from(map_, on_circle(kStart, seconds), at(seconds))));
  }
  std::int64_t count(Outcome outcome, StreamId stream = 1) const {
    return localizer_->outcomes()[stream][static_cast<std::size_t>(outcome)];
  }
  std::int64_t warnings(const std::string& kind) const {
    const auto& counts = localizer_->diagnostics().counts();
    return counts.contains(kind) ? counts.at(kind) : 0;
  }
  // A scan of an open place: nothing within reach.
  Outcome open_scan(double seconds) {
    LaserScan open = scan_from(map_, on_circle(kStart, seconds), at(seconds));
    std::fill(open.ranges_m.begin(), open.ranges_m.end(), std::numeric_limits<float>::infinity());
    return localizer_->process(scan_event(std::move(open)));
  }
  // Odometry at 20 Hz and a scan every 0.2 s between them, from 0 to `seconds`.
  void drive(double seconds) {
    const int steps = static_cast<int>(20 * seconds);
    for (int i = 0; i <= steps; ++i) {
      odometry(0.05 * i);
      if (i % 4 == 0 && i < steps) scan(0.05 * i + 0.013);
    }
    localizer_->finish();
  }

  OccupancyGrid map_ = test::small_room();
  std::vector<StreamInfo> streams_ = test::odometry_and_laser();
  std::unique_ptr<MonteCarloLocalizer> localizer_;
  std::vector<Estimate> estimates_;
};

TEST_F(MonteCarloLocalizerTest, FollowsTheRobot) {
  make();
  drive(10.0);
  ASSERT_EQ(estimates_.size(), 50U);
  for (const Estimate& e : estimates_) {
    const Pose2 truth = on_circle(kStart, to_seconds(e.stamp));
    EXPECT_LT(distance(e.T_map_base, truth), 0.12) << to_seconds(e.stamp);
    EXPECT_LT(std::abs(angle_difference(e.T_map_base.theta, truth.theta)), 0.06) << to_seconds(e.stamp);
    EXPECT_GT(e.quality, 0.9);
  }
}

TEST_F(MonteCarloLocalizerTest, FindsTheRobotAnywhere) {
  LocalizerOptions options;
  options.filter.min_particles = 1000;
  make(options, {});
  drive(15.0);
  const Pose2 truth = on_circle(kStart, to_seconds(estimates_.back().stamp));
  EXPECT_LT(distance(estimates_.back().T_map_base, truth), 0.15);
  EXPECT_GT(estimates_.back().weight, 0.9);
}

TEST_F(MonteCarloLocalizerTest, CrossesAnOpenPlace) {
  LocalizerOptions options = few_particles();
  options.update = {0.05, 0.05};  // half of what the robot moves between two scans
  make(options);
  for (int i = 0; i <= 200; ++i) {
    const double seconds = 0.05 * i;
    odometry(seconds);
    if (i % 4 == 0 && i < 200) (i < 60 || i > 140) ? scan(seconds + 0.013) : open_scan(seconds + 0.013);
  }
  localizer_->finish();
  ASSERT_EQ(estimates_.size(), 50U);
  EXPECT_EQ(count(Outcome::kDroppedMalformed), 0);
  EXPECT_EQ(count(Outcome::kNotNeeded), 21);
  EXPECT_EQ(localizer_->updates(), 29);
  const auto spread = [&](std::size_t i) { return estimates_[i].covariance.topLeftCorner<2, 2>().trace(); };
  EXPECT_GT(spread(34), 3.0 * spread(14));  // from 3 to 7 s nothing tells where the robot is,
  EXPECT_EQ(estimates_[34].quality, estimates_[14].quality);  // nor whether the map fits
  EXPECT_LT(distance(estimates_.back().T_map_base, on_circle(kStart, to_seconds(estimates_.back().stamp))),
            0.12);
}

TEST_F(MonteCarloLocalizerTest, AnywhereBeginsWithAScanThatTellsSomething) {
  LocalizerOptions options;
  options.filter.min_particles = 1000;
  make(options, {});
  odometry(0.0);
  open_scan(0.2);
  odometry(0.5);
  EXPECT_EQ(count(Outcome::kNotNeeded), 1);
  EXPECT_FALSE(localizer_->estimate());
  EXPECT_TRUE(estimates_.empty());
  scan(0.7);
  odometry(1.0);
  EXPECT_EQ(count(Outcome::kUsed), 1);
  EXPECT_TRUE(localizer_->estimate());
}

TEST_F(MonteCarloLocalizerTest, CutsTheMotionAtTheStampOfTheScan) {
  LocalizerOptions options = few_particles();
  options.update = {100.0, 7.0};  // every scan after the first is carried by the odometry alone
  make(options);
  odometry(0.0);
  EXPECT_EQ(scan(0.2), Outcome::kPending);
  EXPECT_EQ(scan(0.7), Outcome::kPending);
  EXPECT_EQ(count(Outcome::kPending), 2);
  odometry(1.0);
  ASSERT_EQ(estimates_.size(), 2U);
  EXPECT_EQ(estimates_[1].stamp, at(0.7));
  const Pose2 moved = between(estimates_[0].T_map_base, estimates_[1].T_map_base);
  const Pose2 expected = on_circle({}, 0.5);
  EXPECT_NEAR(moved.x, expected.x, 1e-9);
  EXPECT_NEAR(moved.y, expected.y, 1e-9);
  EXPECT_NEAR(moved.theta, expected.theta, 1e-9);
  EXPECT_EQ(count(Outcome::kUsed), 1);
  EXPECT_EQ(count(Outcome::kNotNeeded), 1);
  EXPECT_EQ(localizer_->updates(), 1);
}

// 50 scans, 5 a second.
TEST_F(MonteCarloLocalizerTest, AnotherTriggerThanMotionDecidesWhichScansAreUsed) {
  LocalizerOptions options = few_particles();
  options.update.when = "updates";
  options.update.every_n = 3;
  make(options);
  drive(10.0);
  EXPECT_EQ(count(Outcome::kUsed), 17);
  EXPECT_EQ(count(Outcome::kNotNeeded), 33);
  options.update.when = "rate";
  options.update.rate_hz = 2.0;
  make(options);
  drive(10.0);
  EXPECT_EQ(count(Outcome::kUsed), 20);
  EXPECT_EQ(count(Outcome::kNotNeeded), 30);
  options.update.when = "ess";  // a trigger, but not for this
  EXPECT_THAT(refusal(options), HasSubstr("update.when"));
}

TEST_F(MonteCarloLocalizerTest, TellsAtOnceWhatBecameOfAScanThatNeedNotWait) {
  make();
  odometry(0.0);
  EXPECT_EQ(scan(0.0), Outcome::kUsed);
  odometry(1.0);
  EXPECT_EQ(scan(0.9), Outcome::kUsed);
  EXPECT_EQ(scan(0.95), Outcome::kNotNeeded);
  EXPECT_EQ(scan(0.3), Outcome::kReplayed);
}

TEST_F(MonteCarloLocalizerTest, ScansThatComeOutOfOrderAreUsedInOrderWhileTheyWait) {
  make();
  odometry(0.0);
  for (const double t : {0.9, 0.1, 0.5}) EXPECT_EQ(scan(t), Outcome::kPending);
  odometry(1.0);
  ASSERT_EQ(estimates_.size(), 3U);
  EXPECT_EQ(estimates_[0].stamp, at(0.1));
  EXPECT_EQ(estimates_[2].stamp, at(0.9));
}

TEST_F(MonteCarloLocalizerTest, ScansBeforeTheFirstOdometryAreUsedWithARandomWalk) {
  make();
  EXPECT_EQ(scan(0.5), Outcome::kPending);
  odometry(1.0);
  EXPECT_EQ(count(Outcome::kUsed), 1) << "where the robot starts";
  EXPECT_EQ(scan(0.9), Outcome::kUsed) << "it may have gone anywhere in 0.4 s";
  EXPECT_LT(distance(localizer_->estimate()->T_map_base, on_circle(kStart, 1.0)), 0.15);
}

TEST_F(MonteCarloLocalizerTest, TheEndUsesScansUpToHalfASecondAfterTheLastOdometry) {
  make();
  odometry(0.0);
  odometry(1.0);
  scan(1.5);
  scan(1.51);
  localizer_->finish();
  EXPECT_EQ(count(Outcome::kUsed), 1);
  EXPECT_EQ(count(Outcome::kDroppedNoOdometry), 1);
  EXPECT_EQ(count(Outcome::kPending), 0);
}

TEST_F(MonteCarloLocalizerTest, TheEndWithoutAnyOdometryUsesTheScans) {
  make();
  scan(1.0);
  scan(1.5);
  localizer_->finish();
  EXPECT_EQ(count(Outcome::kUsed), 2);
}

TEST_F(MonteCarloLocalizerTest, CountsWhatIsMalformed) {
  make();
  LaserScan nothing = scan_from(map_, kStart, at(1.0));
  nothing.ranges_m.clear();
  EXPECT_EQ(localizer_->process(scan_event(nothing)), Outcome::kDroppedMalformed);
  EXPECT_EQ(localizer_->process({at(1), at(1), 1, std::shared_ptr<const LaserScan>()}),
            Outcome::kDroppedMalformed);
  EXPECT_EQ(localizer_->process(odometry_event(1.0, {std::nan(""), 0, 0})), Outcome::kDroppedMalformed);
  EXPECT_EQ(warnings("malformed scan"), 2);
  EXPECT_EQ(warnings("malformed odometry"), 1);
}

TEST_F(MonteCarloLocalizerTest, CountsEventsOfStreamsThatTheTableLacks) {
  make();
  for (const StreamId stream : {StreamId{2}, StreamId{65535}}) {
    EXPECT_EQ(localizer_->process(odometry_event(1.0, {}, stream)), Outcome::kDroppedUnboundStream);
  }
  EXPECT_EQ(warnings("event of an unknown stream"), 2);
}

TEST_F(MonteCarloLocalizerTest, AnEventOfTheOtherKindIsNotBound) {
  make();
  EXPECT_EQ(localizer_->process(odometry_event(1.0, {}, 1)), Outcome::kDroppedUnboundStream);
  EXPECT_EQ(localizer_->process(scan_event(scan_from(map_, kStart, at(1)), 0)),
            Outcome::kDroppedUnboundStream);
}

TEST_F(MonteCarloLocalizerTest, SensorsWithoutAModelEndInACountedOutcome) {
  make();
  odometry(0.0);
  scan(1.0);
  std::int64_t unbound = 0;
  for (Event event : test::every_sensor().events) {
    if (kind_of(event) == StreamKind::kOdometry || kind_of(event) == StreamKind::kLaserScan) continue;
    for (const StreamId stream : {StreamId{0}, StreamId{1}}) {
      event.stream = stream;
      EXPECT_EQ(localizer_->process(event), Outcome::kDroppedUnboundStream) << name_of(kind_of(event));
      unbound += stream == 1 ? 1 : 0;
    }
  }
  EXPECT_EQ(count(Outcome::kDroppedUnboundStream), unbound);
}

TEST_F(MonteCarloLocalizerTest, AScanCountsOnce) {
  LocalizerOptions options = few_particles();
  options.update = {0.0, 0.0};  // every scan is worth an update
  make(options);
  odometry(0.0);
  EXPECT_EQ(scan(0.5), Outcome::kPending);
  EXPECT_EQ(scan(0.5), Outcome::kDroppedDuplicate) << "while the first waits";
  odometry(1.0);
  EXPECT_EQ(scan(0.5), Outcome::kDroppedDuplicate) << "after the first was used";
  EXPECT_EQ(count(Outcome::kUsed), 1);
  EXPECT_EQ(warnings("duplicate scan"), 2);
}

TEST_F(MonteCarloLocalizerTest, TwoScannersMayShareAStamp) {
  streams_.push_back({"rear", StreamKind::kLaserScan, "", Pose2{}});
  LocalizerOptions options = few_particles();
  options.update = {0.0, 0.0};
  make(options);
  odometry(0.0);
  EXPECT_EQ(localizer_->process(scan_event(scan_from(map_, kStart, at(0)), 1)), Outcome::kUsed);
  EXPECT_EQ(localizer_->process(scan_event(scan_from(map_, kStart, at(0)), 2)), Outcome::kUsed);
}

TEST_F(MonteCarloLocalizerTest, OneOdometryStampFromTheFutureCostsOneMessage) {
  make();
  odometry(0.0);
  EXPECT_EQ(localizer_->process(odometry_event(3.2e7, {50, 50, 0})), Outcome::kPending);
  drive(5.0);
  EXPECT_EQ(count(Outcome::kDroppedOutOfOrder, 0), 1) << "the wrong one";
  EXPECT_EQ(count(Outcome::kDroppedDuplicate, 0), 1) << "0.0 s a second time";
  EXPECT_EQ(count(Outcome::kUsed, 0), 101);
  EXPECT_EQ(warnings("odometry stamp not believed"), 1);
  EXPECT_LT(distance(estimates_.back().T_map_base, on_circle(kStart, to_seconds(estimates_.back().stamp))),
            0.15);
}

TEST_F(MonteCarloLocalizerTest, GoesOnWhereTheClockIsSetBack) {
  make();
  for (int i = 0; i <= 20; ++i) {
    localizer_->process(odometry_event(1000 + 0.05 * i, on_circle({}, 0.05 * i)));
    localizer_->process(scan_event(scan_from(map_, on_circle(kStart, 0.05 * i), at(1000 + 0.05 * i))));
  }
  for (int i = 21; i <= 60; ++i) {
    localizer_->process(odometry_event(0.05 * i, on_circle({}, 0.05 * i)));
    localizer_->process(scan_event(scan_from(map_, on_circle(kStart, 0.05 * i), at(0.05 * i))));
  }
  EXPECT_EQ(warnings("clock set back"), 1);
  EXPECT_EQ(localizer_->estimate()->stamp, at(3.0));
  EXPECT_LT(distance(localizer_->estimate()->T_map_base, on_circle(kStart, 3.0)), 0.15);
}

TEST_F(MonteCarloLocalizerTest, ScansFromTheFutureDoNotPushOutTheOthers) {
  make();
  odometry(0.0);
  const LaserScan seen = scan_from(map_, kStart, at(0));
  for (int i = 0; i < 1500; ++i) {
    LaserScan later = seen;
    later.stamp = at(1e6 + i);
    Event event = scan_event(later);
    event.arrival = at(1e-4 * i);
    localizer_->process(event);
  }
  EXPECT_EQ(count(Outcome::kPending), 1000) << "the queue is bounded";
  EXPECT_EQ(count(Outcome::kDroppedNoOdometry), 500);
  scan(0.5);
  odometry(1.0);
  EXPECT_EQ(count(Outcome::kUsed), 1);
  localizer_->finish();
  EXPECT_EQ(count(Outcome::kPending), 0);
}

TEST_F(MonteCarloLocalizerTest, RefusesAStartOffTheMap) {
  for (const Pose2& pose :
       {Pose2{-0.01, 1, 0}, Pose2{1, 6.01, 0}, Pose2{1e300, 1, 0}, Pose2{1, -1e300, 0},
        Pose2{std::nan(""), 1, 0}, Pose2{1, 1, std::numeric_limits<double>::infinity()}}) {
    EXPECT_THAT(refusal(few_particles(), {pose}), HasSubstr("start pose: lies off the map"));
  }
  EXPECT_EQ(refusal(few_particles(), {Pose2{0.01, 5.99, 0}}), "accepted");
}

TEST_F(MonteCarloLocalizerTest, RefusesToStartAnywhereInAMapWithoutFreeCell) {
  map_ = {map_.geometry(), std::vector<OccupancyGrid::Cell>(map_.geometry().size(), 100)};
  EXPECT_THAT(refusal(few_particles(), {}), HasSubstr("no free cell"));
}

TEST_F(MonteCarloLocalizerTest, NamesTheStreamsWhereOneIsUnknown) {
  LocalizerOptions options = few_particles();
  options.streams["lazer"] = {};
  EXPECT_THAT(refusal(options), AllOf(HasSubstr("streams.lazer"), HasSubstr("its laser streams: laser")));
  options = few_particles();
  options.streams["odom"] = {};
  EXPECT_THAT(refusal(options), HasSubstr("no such laser stream")) << "the odometry is none";
  options = few_particles();
  options.odometry_stream = "wheels";
  EXPECT_THAT(refusal(options), AllOf(HasSubstr("'wheels'"), HasSubstr("its odometry streams: odom")));
  options = few_particles();
  options.streams["laser"].use = false;
  EXPECT_THAT(refusal(options), HasSubstr("no laser stream is in use"));
}

TEST_F(MonteCarloLocalizerTest, RefusesALogWithoutOdometry) {
  streams_.erase(streams_.begin());
  EXPECT_THAT(refusal(few_particles()), HasSubstr("the log has no odometry; its odometry streams: none"));
}

TEST_F(MonteCarloLocalizerTest, RefusesOptionsOutOfRange) {
  LocalizerOptions options = few_particles();
  options.filter.particles = -5;
  EXPECT_THAT(refusal(options), HasSubstr("filter.particles"));
}

TEST_F(MonteCarloLocalizerTest, TheSnapshotIsASampleOfTheBelief) {
  make();
  drive(2.0);
  const ParticleSnapshot snapshot = localizer_->snapshot(40);
  EXPECT_EQ(snapshot.particles.size(), 40U);
  EXPECT_EQ(snapshot.stamp, localizer_->estimate()->stamp);
  for (const Pose2& p : snapshot.particles) EXPECT_LT(distance(p, localizer_->estimate()->T_map_base), 1.0);
  EXPECT_TRUE(localizer_->snapshot(0).particles.empty());
  EXPECT_EQ(localizer_->snapshot(100000).particles.size(), 300U);
}

bool same_bytes(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Estimate& x, const Estimate& y) {
    return x.stamp == y.stamp && x.T_map_base == y.T_map_base && x.covariance == y.covariance &&
           x.ess == y.ess && x.particles == y.particles && x.hypotheses == y.hypotheses &&
           x.weight == y.weight && x.quality == y.quality;
  });
}

TEST_F(MonteCarloLocalizerTest, TheSameBytesForAnyNumberOfThreads) {
  for (const char* recipe : {"mcl", "kld_mcl"}) {
    LocalizerOptions options;
    options.recipe = recipe;
    const auto run = [&](int threads, std::uint64_t seed) {
      make(options, {}, threads, seed);
      drive(3.0);
      return estimates_;
    };
    const std::vector<Estimate> one = run(1, 1);
    ASSERT_EQ(one.size(), 15U);
    for (const int threads : {1, 2, 7}) EXPECT_TRUE(same_bytes(run(threads, 1), one)) << recipe << threads;
    EXPECT_FALSE(same_bytes(run(1, 2), one)) << "the seed has no effect";
  }
}

// Random schedules with every fault that a stream of events can have.
class Schedule {
 public:
  Schedule(const OccupancyGrid& map, std::uint64_t seed)
      : random_(seed, RandomPurpose::kSimulation, 0), scan_(scan_from(map, kStart, Time{}, 12)) {
    for (int i = 0; i < 120; ++i) events_.push_back(draw(0.05 * i));
    for (std::size_t i = 1; i < events_.size(); ++i) {
      if (chance(0.1)) std::swap(events_[i], events_[i - 1]);
      if (chance(0.05)) events_[i] = events_[i - 1];
    }
  }

  const std::vector<Event>& events() const { return events_; }

 private:
  double uniform() { return random_.uniform4(item_++)[0]; }
  bool chance(double p) { return uniform() < p; }

  double wrong_stamp() {
    const double stamps[] = {-1e6, 0.0, 1e6, 9e9, -9e9, 20.0, 3.2e7};
    return stamps[static_cast<std::size_t>(7 * uniform())];
  }

  StreamId stream() {
    return chance(0.1) ? static_cast<StreamId>(7 * uniform()) : static_cast<StreamId>(2 * uniform());
  }

  Event draw(double seconds) {
    const double t = chance(0.1) ? wrong_stamp() : seconds;
    const StreamId id = stream();
    Event event = chance(0.95) == (id == 0) ? odometry(t, id) : scan(t, id);
    if (chance(0.03)) event.stamp += Duration(1);
    return event;
  }

  Event odometry(double t, StreamId id) {
    Pose2 pose = on_circle({}, std::fmod(t, 10.0));
    if (chance(0.03)) pose.x = std::nan("");
    if (chance(0.03)) pose.y = 1e300;
    return odometry_event(t, pose, id);
  }

  Event scan(double t, StreamId id) {
    LaserScan scan = scan_;
    scan.stamp = at(t);
    if (chance(0.03)) scan.ranges_m.clear();
    if (chance(0.03)) scan.angle_increment_rad = 1e308;
    if (chance(0.03)) return {scan.stamp, scan.stamp, id, std::shared_ptr<const LaserScan>()};
    return scan_event(scan, id);
  }

  RandomStream random_;
  std::uint32_t item_ = 0;
  LaserScan scan_;
  std::vector<Event> events_;
};

std::int64_t sum(const std::vector<OutcomeCounts>& outcomes) {
  std::int64_t total = 0;
  for (const OutcomeCounts& counts : outcomes) {
    for (const std::int64_t n : counts) {
      EXPECT_GE(n, 0);
      total += n;
    }
  }
  return total;
}

TEST_F(MonteCarloLocalizerTest, AccountsForEveryEventWhateverComes) {
  streams_.push_back({"rear", StreamKind::kLaserScan, "", Pose2{}});
  streams_.push_back({"wheels", StreamKind::kOdometry, "", {}});
  LocalizerOptions options = few_particles();
  options.filter.particles = 20;
  options.streams["laser"] = {};
  OutcomeCounts seen{};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    make(options, {kStart}, 1, seed);
    const Schedule schedule(map_, seed);
    std::int64_t received = 0;
    for (const Event& event : schedule.events()) {
      localizer_->process(event);
      ++received;
      ASSERT_EQ(sum(localizer_->outcomes()) + warnings("event of an unknown stream"), received) << seed;
    }
    localizer_->finish();
    ASSERT_EQ(sum(localizer_->outcomes()) + warnings("event of an unknown stream"), received) << seed;
    for (const OutcomeCounts& counts : localizer_->outcomes()) {
      ASSERT_EQ(counts[static_cast<std::size_t>(Outcome::kPending)], 0) << seed;
      for (std::size_t k = 0; k < kOutcomeCount; ++k) seen[k] += counts[k];
    }
    ASSERT_EQ(localizer_->updates(), count(Outcome::kUsed) + count(Outcome::kReplayed));
    for (const Estimate& e : estimates_)
      ASSERT_TRUE(is_finite(e.T_map_base) && e.covariance.allFinite()) << seed;
    const bool in_order = std::is_sorted(estimates_.begin(), estimates_.end(),
                                         [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    const bool set_back = warnings("clock set back") + warnings("arrival clock set back") > 0;
    ASSERT_TRUE(in_order || set_back) << seed;
  }
  for (std::size_t k = 0; k < kOutcomeCount; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    const bool budget = outcome == Outcome::kDeferred || outcome == Outcome::kDroppedOverBudget;
    EXPECT_EQ(seen[k] > 0, outcome != Outcome::kPending && !budget) << to_string(outcome);
  }
}

}  // namespace
}  // namespace cairn
