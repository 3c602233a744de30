#include "fake_fusion.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::fake_measurement;
using test::fake_parts;

class FusionLocalizerTest : public ::testing::Test {
 protected:
  void make(FusionParts parts) {
    localizer_ = std::make_unique<FusionLocalizer>(std::move(parts));
    localizer_->set_observer([this](const Estimate& e) { told_.push_back(to_seconds(e.stamp)); });
  }
  void SetUp() override { make(fake_parts(&filter_, {1.0, 1.0})); }

  Outcome odometry(double t) { return localizer_->process(test::odometry_event(t, {t, 0, 0})); }
  Outcome measure(double t, StreamId stream = 1, double lag = 0.0) {
    return localizer_->process(fake_measurement(t, stream, lag));
  }
  void odometry_until(double end, double from = 0.0) {
    for (double t = from; t < end + 1e-9; t += 0.1) odometry(t);
  }
  std::int64_t count(Outcome outcome, StreamId stream = 1) const {
    return localizer_->outcomes()[stream][static_cast<std::size_t>(outcome)];
  }
  std::int64_t warnings(const std::string& kind) const {
    const auto& counts = localizer_->diagnostics().counts();
    return counts.contains(kind) ? counts.at(kind) : 0;
  }

  test::FakeFilter::State filter_;
  std::unique_ptr<FusionLocalizer> localizer_;
  std::vector<double> told_;
};

TEST_F(FusionLocalizerTest, TheEstimateIsAlwaysCurrent) {
  odometry_until(1.0);
  EXPECT_FALSE(localizer_->estimate());
  measure(0.0);
  measure(0.55);
  const Estimate estimate = *localizer_->estimate();
  EXPECT_EQ(estimate.belief_stamp, at(0.55));
  EXPECT_NEAR(to_seconds(estimate.stamp), 1.0, 1e-6) << "the newest odometry";
  EXPECT_NEAR(estimate.T_map_base.x, 1.0, 1e-9) << "carried there";
  EXPECT_NEAR(estimate.T_map_odom.x, 0.0, 1e-9);
  EXPECT_EQ(told_, (std::vector<double>{0.0, 0.55})) << "the observer is told the stamps of the measurements";
}

TEST_F(FusionLocalizerTest, CarriesTheErrorOfTheHeading) {
  struct Leaning final : PoseFilter {
    void initialize(const Sampler&) override {}
    void predict(const PoseControl&) override {}
    void correct(const BoundUpdate<Pose2>&) override {}
    bool compact() const override { return true; }
    std::size_t size() const override { return 1; }
    PoseSummary summarize() const override {
      PoseSummary summary;
      summary.covariance(2, 2) = 0.01;
      return summary;
    }
    std::vector<Pose2> sample(std::size_t) const override { return {}; }
    std::unique_ptr<Checkpoint> new_checkpoint() const override { return std::make_unique<Checkpoint>(); }
    void save(Checkpoint&) const override {}
    void restore(const Checkpoint&) override {}
  };
  FusionParts parts = fake_parts(nullptr);
  parts.filter = std::make_unique<Leaning>();
  make(std::move(parts));
  odometry(0.0);
  measure(0.0);
  odometry(3.0);
  const Eigen::Matrix3d covariance = localizer_->estimate()->covariance;
  EXPECT_NEAR(covariance(1, 1), 0.09, 1e-12) << "0.1 rad, 3 m ahead";
  EXPECT_NEAR(covariance(1, 2), 0.03, 1e-12);
  EXPECT_NEAR(covariance(0, 0), 0.0, 1e-12);
}

TEST_F(FusionLocalizerTest, WhatComesLateIsPutAtItsTrueTime) {
  odometry_until(2.0);
  for (const double t : {0.1, 0.5, 0.9, 1.3}) measure(t);
  EXPECT_EQ(measure(0.7, 2, 1.0), Outcome::kReplayed);
  const auto late = filter_;
  EXPECT_EQ(localizer_->rewinds(), 1);
  EXPECT_EQ(told_, (std::vector<double>{0.1, 0.5, 0.9, 1.3, 1.3})) << "the newest belief, as it now is";
  EXPECT_EQ(late.corrections, 5);

  make(fake_parts(&filter_, {1.0, 1.0}));
  odometry_until(2.0);
  for (const double t : {0.1, 0.5}) measure(t);
  measure(0.7, 2);
  for (const double t : {0.9, 1.3}) measure(t);
  EXPECT_EQ(filter_, late) << "as if it had come in time";
  EXPECT_EQ(localizer_->rewinds(), 0);
}

TEST_F(FusionLocalizerTest, LateOdometryChangesWhatFollowed) {
  odometry(0.0);
  odometry(1.0);
  measure(0.2);
  measure(0.5);
  EXPECT_EQ(localizer_->process(test::odometry_event(0.4, {0.1, 0, 0})), Outcome::kReplayed);
  const auto late = filter_;
  make(fake_parts(&filter_, {1.0, 1.0}));
  odometry(0.0);
  localizer_->process(test::odometry_event(0.4, {0.1, 0, 0}));
  odometry(1.0);
  measure(0.2);
  measure(0.5);
  EXPECT_EQ(filter_, late);
}

TEST_F(FusionLocalizerTest, OlderThanTheHistoryIsStale) {
  odometry_until(5.0);
  measure(0.1);
  measure(4.9);
  EXPECT_EQ(measure(2.5, 2, 2.0), Outcome::kDroppedStale);
  EXPECT_EQ(measure(3.5, 2, 2.0), Outcome::kReplayed);
}

TEST_F(FusionLocalizerTest, DropAndDelayNeverGoBack) {
  for (const char* policy : {"drop", "delay"}) {
    FusionParts parts = fake_parts(&filter_, {1.0, 1.0});
    parts.time.late_policy = policy;
    make(std::move(parts));
    for (int i = 0; i <= 60; ++i) {
      odometry(0.1 * i);
      measure(0.1 * i, 1);
      if (i >= 5) measure(0.1 * i - 0.5, 2, 0.5);
    }
    localizer_->finish();
    EXPECT_EQ(localizer_->rewinds(), 0);
    EXPECT_EQ(count(Outcome::kUsed, 1), 61) << policy;
    const double lost = drop_rate(localizer_->outcomes()[2]);
    if (policy == std::string("drop")) {
      EXPECT_EQ(lost, 1.0) << "the delayed stream is lost entirely";
    } else {
      EXPECT_LT(lost, 0.1) << "but for those before its lag was known";
    }
  }
}

TEST_F(FusionLocalizerTest, MissingOdometryIsARandomWalk) {
  odometry_until(1.0);
  for (int i = 0; i <= 40; ++i) measure(0.1 * i);
  localizer_->finish();
  EXPECT_EQ(filter_.corrections, 41);
  EXPECT_NEAR(filter_.unknown_s, 3.0, 1e-6);
  EXPECT_EQ(warnings("silent stream"), 1) << "told, by its name";
  EXPECT_NE(localizer_->diagnostics().examples()[0].text.find("stream odom"), std::string::npos);
}

TEST_F(FusionLocalizerTest, OdometryThatComesBackTellsWhereTheRobotWas) {
  odometry_until(1.0);
  for (int i = 0; i <= 25; ++i) measure(0.1 * i);
  EXPECT_GT(filter_.unknown_s, 0.5);
  odometry(2.6);
  EXPECT_NEAR(filter_.unknown_s, 0.0, 1e-9) << "what had been guessed is done again";
  EXPECT_NEAR(filter_.pose.x, 2.5, 1e-6);
}

TEST_F(FusionLocalizerTest, WithoutOdometryAtAll) {
  FusionParts parts = fake_parts(&filter_);
  parts.streams.odometry.reset();
  make(std::move(parts));
  for (int i = 0; i <= 20; ++i) measure(0.1 * i);
  EXPECT_EQ(odometry(1.0), Outcome::kDroppedUnboundStream);
  localizer_->finish();
  EXPECT_EQ(filter_.corrections, 21);
  EXPECT_NEAR(filter_.unknown_s, 2.0, 1e-6);
}

TEST_F(FusionLocalizerTest, DefersWhatTheBudgetDoesNotAllowNow) {
  FusionParts parts = fake_parts(&filter_, {100.0, 1.0});  // an update of stream 1 costs 100 ms
  parts.scheduler.policy = "cfs";
  parts.scheduler.compute_share = 0.5;
  make(std::move(parts));
  for (int i = 0; i <= 100; ++i) {
    odometry(0.1 * i);
    if (i < 20) measure(0.1 * i, 1);  // asks for twice the budget in the first two seconds
    measure(0.1 * i, 2);
  }
  localizer_->finish();
  EXPECT_GT(count(Outcome::kDeferred, 1), 0);
  EXPECT_EQ(drop_rate(localizer_->outcomes()[2]), 0.0) << "the cheap stream loses nothing";
  EXPECT_EQ(count(Outcome::kPending, 1), 0);
}

TEST_F(FusionLocalizerTest, UnderLastingOverloadTheCheapStreamIsServedAndTheRestIsCounted) {
  FusionParts parts = fake_parts(&filter_, {50.0, 1.0});
  parts.scheduler.policy = "cfs";
  parts.scheduler.compute_share = 0.2;  // stream 1 alone asks for 0.5
  parts.scheduler.queue = 3;
  parts.time.late_policy = "drop";
  make(std::move(parts));
  for (int i = 0; i <= 600; ++i) {
    odometry(0.1 * i);
    measure(0.1 * i, 1);
    measure(0.1 * i, 2);
  }
  localizer_->finish();
  EXPECT_LT(drop_rate(localizer_->outcomes()[2]), 0.1) << "what waited behind the other one came too late";
  EXPECT_GT(count(Outcome::kDroppedOverBudget, 1), 300);
  EXPECT_GT(count(Outcome::kUsed, 1) + count(Outcome::kDeferred, 1), 150) << "0.19 s a second at 50 ms";
}

// A live stream of 5 ms at 10 Hz, and one of 1 ms at 10 Hz that is half a second late: each of the latter one
// by one would cost 25 ms of doing again, 310 ms per second in all.
TEST_F(FusionLocalizerTest, LateOnesArePutInTogetherWhereTimeIsShort) {
  FusionParts parts = fake_parts(&filter_, {5.0, 1.0});
  parts.scheduler.policy = "cfs";
  parts.scheduler.compute_share = 0.18;
  parts.scheduler.queue = 32;
  make(std::move(parts));
  double behind_s = 0.0;
  for (int i = 0; i <= 600; ++i) {
    odometry(0.1 * i);
    measure(0.1 * i, 1);
    if (i >= 5) measure(0.1 * i - 0.5, 2, 0.5);
    if (i < 20) continue;
    const Estimate now = *localizer_->estimate();
    behind_s = std::max(behind_s, to_seconds(now.stamp - now.belief_stamp));
  }
  localizer_->finish();
  EXPECT_EQ(drop_rate(localizer_->outcomes()[1]), 0.0);
  EXPECT_LT(drop_rate(localizer_->outcomes()[2]), 0.02);
  EXPECT_LT(behind_s, 0.35) << "going back does not keep the live stream waiting";
}

TEST_F(FusionLocalizerTest, TheRateIsThatOfTheStamps) {
  FusionParts parts = fake_parts(&filter_, {1.0, 1.0});
  parts.scheduler.policy = "rate";
  parts.scheduler.rate_hz = 2.0;
  make(std::move(parts));
  for (int i = 0; i <= 40; ++i) {
    odometry(0.1 * i);
    measure(0.1 * i, 1);
  }
  EXPECT_EQ(count(Outcome::kUsed), 9);
  EXPECT_EQ(count(Outcome::kNotNeeded), 32);
}

TEST_F(FusionLocalizerTest, StampsMayBeCorrected) {
  FusionParts parts = fake_parts(&filter_);
  parts.streams.stamp_offsets[1] = std::chrono::milliseconds(-300);
  make(std::move(parts));
  odometry_until(1.0);
  measure(0.8);
  EXPECT_EQ(localizer_->estimate()->belief_stamp, at(0.5));
}

TEST_F(FusionLocalizerTest, AWrongArrivalDoesNotStopTheClock) {
  odometry_until(1.0);
  measure(0.5);
  measure(0.6, 1, 1e5);
  measure(0.7);
  measure(0.8, 1, -1e5);
  measure(0.9);
  odometry(1.1);
  localizer_->finish();
  EXPECT_EQ(count(Outcome::kUsed), 5);
}

}  // namespace
}  // namespace cairn
