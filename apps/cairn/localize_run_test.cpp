#include "apps/cairn/localize_run.hpp"

#include "cairn/core/errors.hpp"
#include "small_room.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::app {
namespace {

using ::testing::HasSubstr;

const Pose2 kStart{2.0, 1.5, 0.0};

// Four seconds of a circle in the small room: odometry at 20 Hz, a scan with every fourth.
class LocalizeRun : public ::testing::Test {
 protected:
  LocalizeRun() {
    log_.streams = test::odometry_and_laser();
    for (int i = 0; i <= 80; ++i) {
      log_.events.push_back(test::odometry_event(0.05 * i, test::on_circle({}, 0.05 * i)));
      if (i % 4 == 0) {
        const Pose2 pose = test::on_circle(kStart, 0.05 * i);
        log_.events.push_back(test::scan_event(test::scan_from(*map_, pose, test::at(0.05 * i))));
      }
    }
    request_.log = &log_;
    request_.map = map_;
    request_.start = {kStart};
    request_.options.filter.min_particles = 200;
  }

  std::shared_ptr<const OccupancyGrid> map_ = std::make_shared<const OccupancyGrid>(test::small_room());
  Log log_;
  LocalizeRequest request_;
};

TEST_F(LocalizeRun, GivesAnEstimatePerScanAndAccountsForAll) {
  const LocalizeResult result = localize(request_);
  EXPECT_EQ(result.estimates.size(), 21U);
  EXPECT_FALSE(result.interrupted);
  EXPECT_FALSE(judge_end(result.estimates).lost);
  std::int64_t events = 0;
  for (const OutcomeCounts& counts : result.outcomes) {
    for (const std::int64_t n : counts) events += n;
  }
  EXPECT_EQ(events, static_cast<std::int64_t>(log_.events.size()));
  EXPECT_EQ(result.updates, result.outcomes[1][static_cast<std::size_t>(Outcome::kUsed)]);
}

TEST_F(LocalizeRun, ALiveRunTellsWhatTheRobotHadAtEachMoment) {
  request_.live = true;
  const LocalizeResult live = localize(request_);
  ASSERT_EQ(live.estimates.size(), 81U) << "one per message of the odometry, not one per scan";
  for (int i = 0; i <= 80; ++i) {
    const Estimate& now = live.estimates[static_cast<std::size_t>(i)];
    EXPECT_EQ(now.stamp, test::at(0.05 * i));
    EXPECT_LE(now.stamp - now.belief_stamp, std::chrono::milliseconds(201));
    EXPECT_LT(distance(now.T_map_base, test::on_circle(kStart, 0.05 * i)), 0.1);
  }
  request_.live = false;
  EXPECT_EQ(localize(request_).updates, live.updates);
}

TEST_F(LocalizeRun, ALiveRunDoesNotForeseeWhatComesLate) {
  for (Event& event : log_.events) {
    if (std::holds_alternative<Odometry>(event.payload)) continue;
    event.arrival = event.stamp + std::chrono::milliseconds(510);
  }
  std::stable_sort(log_.events.begin(), log_.events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  request_.live = true;
  const LocalizeResult live = localize(request_);
  ASSERT_GT(live.estimates.size(), 60U);
  for (std::size_t i = 1; i < live.estimates.size(); ++i) {
    const Estimate& now = live.estimates[i];
    EXPECT_GT(now.stamp, live.estimates[i - 1].stamp);
    EXPECT_GE(to_seconds(now.stamp - now.belief_stamp), 0.49) << "carried on by the odometry alone";
  }
}

TEST_F(LocalizeRun, SnapshotsAreSpreadOverTheRun) {
  const LocalizeResult result = localize(request_);
  ASSERT_GE(result.snapshots.size(), 10U);
  EXPECT_LT(to_seconds(result.snapshots.front().stamp), 0.3);
  EXPECT_GT(to_seconds(result.snapshots.back().stamp), 3.7);
  for (std::size_t i = 1; i < result.snapshots.size(); ++i) {
    EXPECT_GT(result.snapshots[i].stamp, result.snapshots[i - 1].stamp);
    EXPECT_LE(result.snapshots[i].particles.size(), 200U);
  }
}

TEST_F(LocalizeRun, EndsWhereItIsToldTo) {
  request_.go_on = [](std::int64_t done) { return done < 50; };
  const LocalizeResult result = localize(request_);
  EXPECT_TRUE(result.interrupted);
  EXPECT_LT(result.estimates.size(), 12U);
  EXPECT_GT(result.estimates.size(), 5U);
}

TEST_F(LocalizeRun, TakesALogWithoutEvents) {
  log_.events.clear();
  const LocalizeResult result = localize(request_);
  EXPECT_TRUE(result.estimates.empty());
  EXPECT_TRUE(result.snapshots.empty());
  EXPECT_THAT(judge_end(result.estimates).reason, HasSubstr("no scan could be used"));
}

TEST_F(LocalizeRun, RefusesAsTheLocalizerDoes) {
  request_.threads = 0;
  EXPECT_THROW(localize(request_), ConfigurationError);
  request_.threads = 1;
  request_.start = {Pose2{-1.0, 0.0, 0.0}};
  EXPECT_THROW(localize(request_), ConfigurationError);
}

Estimate good_estimate() {
  Estimate e;
  e.covariance = 0.01 * Eigen::Matrix3d::Identity();
  e.quality = 0.9;
  e.weight = 1.0;
  e.hypotheses = 1;
  return e;
}

EndVerdict verdict(int count, void (*spoil)(Estimate&)) {
  std::vector<Estimate> estimates(30, good_estimate());
  for (int i = 0; i < 30; ++i) estimates[i].belief_stamp = test::at(i);
  for (int i = 0; i < count; ++i) spoil(estimates[estimates.size() - 1 - i]);
  return judge_end(estimates);
}

TEST(JudgeEnd, LooksAtTheLastScans) {
  const auto blind = [](Estimate& e) { e.quality = 0.0; };
  EXPECT_FALSE(verdict(0, blind).lost);
  EXPECT_FALSE(verdict(4, blind).lost) << "0.9 * 16 / 20 = 0.72";
  EXPECT_TRUE(verdict(5, blind).lost) << "0.9 * 15 / 20 = 0.675";
  EXPECT_THAT(verdict(20, blind).reason, HasSubstr("explains only 0 % of the beams of the last 20 scans"));
}

TEST(JudgeEnd, CountsAScanOnceHoweverOftenItsBeliefIsTold) {
  std::vector<Estimate> estimates;
  for (int moment = 0; moment < 300; ++moment) {  // ten to a scan
    estimates.push_back(good_estimate());
    estimates.back().belief_stamp = test::at(moment / 10);
    if (moment >= 260) estimates.back().quality = 0.0;  // of the last four
  }
  EXPECT_FALSE(judge_end(estimates).lost) << "0.9 * 16 / 20 = 0.72";
  estimates[259].quality = 0.0;
  EXPECT_TRUE(judge_end(estimates).lost) << "0.9 * 15 / 20 = 0.675";
}

TEST(JudgeEnd, TheMonitorSaysLost) {
  const auto lost = [](Estimate& e) {
    e.judgement.explained = e.judgement.beyond = 0.4;
    e.judgement.state = TrackingState::kLost;
    e.judgement.probability = 0.03;
  };
  EXPECT_FALSE(verdict(10, lost).lost);
  EXPECT_TRUE(verdict(11, lost).lost);
  EXPECT_THAT(verdict(11, lost).reason, HasSubstr("probability of 3 % only"));
}

TEST(JudgeEnd, AWideOrDividedBeliefIsLost) {
  const auto wide = [](Estimate& e) { e.covariance(0, 0) = 4.0; };
  EXPECT_THAT(verdict(1, wide).reason, HasSubstr("known to 2.0 m only"));
  EXPECT_TRUE(verdict(1, wide).lost);
  const auto divided = [](Estimate& e) {
    e.weight = 0.4;
    e.hypotheses = 3;
  };
  EXPECT_THAT(verdict(1, divided).reason, HasSubstr("3 places fit about equally well"));
  EXPECT_TRUE(verdict(1, divided).lost);
}

}  // namespace
}  // namespace cairn::app
