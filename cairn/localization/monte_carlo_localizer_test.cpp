#include "cairn/localization/monte_carlo_localizer.hpp"

#include "cairn/core/errors.hpp"
#include "every_sensor.hpp"
#include "monte_carlo_fixture.hpp"
#include "small_room.hpp"

#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::few_particles;
using test::kStart;
using test::MonteCarloLocalizerTest;
using test::odometry_event;
using test::on_circle;
using test::scan_event;
using test::scan_from;
using ::testing::HasSubstr;

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

TEST_F(MonteCarloLocalizerTest, SaysSoWhereTheMapIsTooLargeForARecovery) {
  LocalizerOptions options;
  make(options);
  EXPECT_EQ(warnings("no recovery"), 0);
  options.recovery.most_million_cells = 0.001;
  make(options);
  EXPECT_EQ(warnings("no recovery"), 1);
  options.recovery.active = false;
  make(options);
  EXPECT_EQ(warnings("no recovery"), 0);
}

TEST_F(MonteCarloLocalizerTest, SaysSoWhereTheMapIsTooLargeForAGlobalSearch) {
  LocalizerOptions options;
  options.global.most_million_cells = 0.001;
  make(options);
  EXPECT_EQ(warnings("no search"), 0) << "the start is known";
  make(options, {});
  EXPECT_EQ(warnings("no search"), 1);
  options.global.most_poses = 0;
  make(options, {});
  EXPECT_EQ(warnings("no search"), 0) << "none was asked for";
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

TEST_F(MonteCarloLocalizerTest, AMountThatTheLogOverridesIsTold) {
  LocalizerOptions options = few_particles();
  options.streams["laser"].T_base_sensor = {0.3, 0.0, 0.0};
  make(options);
  EXPECT_EQ(warnings("mount of the configuration not used: the log tells one"), 1);
  options.streams["laser"].mount_from_log = false;
  make(options);
  EXPECT_EQ(warnings("mount of the configuration not used: the log tells one"), 0);
}

}  // namespace
}  // namespace cairn
