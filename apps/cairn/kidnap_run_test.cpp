#include "apps/cairn/kidnap_run.hpp"

#include "small_room.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

using test::at;

// Ten metres east at 1 m/s, with odometry that begins elsewhere.
struct Drive {
  Drive() {
    log.streams.push_back({});
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.1 * i;
      log.events.push_back({at(t), at(t), 0, Odometry{at(t), Pose2{5.0, 5.0, 1.0} * Pose2{t, 0, 0}}});
      reference.push_back({at(t), {t, 0.0, 0.0}});
    }
  }
  PosedLog posed() const { return {&log, &reference}; }
  Log log;
  Trajectory reference;
};
const KidnapOptions kShort{2.0, 2.0, 3.0, ""};

TEST(Kidnap, InstantsLieInsideAndFarApart) {
  const Drive drive;
  const auto chosen = choose_kidnappings(drive.posed(), drive.posed(), 20, 7, kShort);
  ASSERT_EQ(chosen.size(), 20u);
  for (const Kidnapping& k : chosen) {
    EXPECT_GE(k.from, at(2.0));
    EXPECT_LE(k.to, at(8.0));
    EXPECT_GE(k.distance_m, 3.0);
  }
  const auto again = choose_kidnappings(drive.posed(), drive.posed(), 20, 7, kShort);
  EXPECT_EQ(again.back().from, chosen.back().from);
}

TEST(Kidnap, TheOdometryGoesOnAsIfNothingHadHappened) {
  const Drive drive;
  const Splice joined = splice(drive.posed(), drive.posed(), {at(3.0), at(7.0), 4.0}, kShort);
  EXPECT_EQ(joined.kidnapped, at(3.0));
  const Event* before = nullptr;
  for (const Event& event : joined.log.events) {
    const Pose2& now = std::get<Odometry>(event.payload).T_odom_base;
    if (before != nullptr) {
      EXPECT_GT(event.stamp, before->stamp);
      EXPECT_LT(distance(now, std::get<Odometry>(before->payload).T_odom_base), 0.11);
    }
    before = &event;
  }
  EXPECT_NEAR(pose_at(joined.reference, at(2.9))->x, 2.9, 1e-9);
  EXPECT_NEAR(pose_at(joined.reference, at(3.2))->x, 7.1, 1e-9);  // carried: 0.1 s later at 7 m
}

JudgedEstimate judged(double t, double error_m, TrackingState state, double probability) {
  JudgedEstimate e;
  e.estimate.stamp = at(t);
  e.error_m = error_m;
  e.estimate.judgement.state = state;
  e.estimate.judgement.probability = probability;
  return e;
}

TEST(Kidnap, TheOutcomeCountsFromTheKidnapping) {
  std::vector<JudgedEstimate> run;
  for (int i = 0; i < 10; ++i) run.push_back(judged(i, 0.1, TrackingState::kTracking, 0.99));
  run[4].estimate.judgement.state = run[5].estimate.judgement.state = TrackingState::kLost;
  for (int i = 10; i < 20; ++i)
    run.push_back(judged(i, i < 14 ? 5.0 : 0.1, TrackingState::kLost, i == 12 ? 0.99 : 0.1));
  const KidnapOutcome outcome = judge_kidnapping(run, at(9.5));
  EXPECT_TRUE(outcome.right_before);
  EXPECT_EQ(outcome.false_alarms, 1);
  EXPECT_NEAR(outcome.lost_after_s, 0.5, 1e-9);
  EXPECT_NEAR(outcome.found_after_s, 4.5, 1e-9);
  EXPECT_NEAR(outcome.sure_and_wrong_s, 1.0, 1e-9);
}

TEST(Kidnap, AMomentOfLuckIsNotFound) {
  std::vector<JudgedEstimate> run;
  for (int i = 0; i < 20; ++i) run.push_back(judged(i, i == 5 ? 0.1 : 5.0, TrackingState::kTracking, 0.5));
  EXPECT_LT(judge_kidnapping(run, at(0.5)).found_after_s, 0.0);
  EXPECT_LT(judge_kidnapping(run, at(0.5)).lost_after_s, 0.0);
}

}  // namespace
}  // namespace cairn::app
