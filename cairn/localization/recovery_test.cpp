#include "cairn/localization/recovery.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "fake_fusion.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;

/// Finds one place, with a given evidence against the belief.
class FoundElsewhere final : public StreamModel {
 public:
  explicit FoundElsewhere(double log_odds) : log_odds_(log_odds) {}
  BoundUpdate<Pose2> bind(const Event::Payload&, bool) const override { return {}; }
  double explained_share(const Event::Payload&, const Pose2&) const override { return 1.0; }
  double beams(const Event::Payload&) const override { return 1.0; }
  bool informs(const Event::Payload&) const override { return true; }
  std::optional<SearchFinding> search(std::span<const Glimpse> glimpses,
                                      std::span<const Pose2> asked) const override {
    ++searches_;
    glimpses_.assign(glimpses.begin(), glimpses.end());
    SearchFinding finding;
    finding.poses = {{kPlace, 1e-4 * Eigen::Matrix3d::Identity(), 1.0, 0.0}};
    finding.log_evidence = log_odds_;
    finding.log_likelihood.assign(asked.size(), 0.0);
    return finding;
  }

  static constexpr Pose2 kPlace{7.0, 3.0, 1.0};
  mutable int searches_ = 0;
  mutable std::vector<Glimpse> glimpses_;

 private:
  double log_odds_;
};

/// Remembers what came in.
class Listener final : public PoseFilter {
 public:
  void initialize(const Sampler&) override {}
  void predict(const PoseControl&) override {}
  void correct(const BoundUpdate<Pose2>&) override {}
  void take_in(std::span<const Pose2> states, std::span<const double> weights, double share) override {
    states_.assign(states.begin(), states.end());
    weights_.assign(weights.begin(), weights.end());
    share_ = share;
  }
  bool compact() const override { return true; }
  std::size_t size() const override { return 1; }
  PoseSummary summarize() const override { return {}; }
  std::vector<Pose2> sample(std::size_t at_most) const override { return std::vector<Pose2>(at_most); }
  std::unique_ptr<Checkpoint> new_checkpoint() const override { return nullptr; }
  void save(Checkpoint&) const override {}
  void restore(const Checkpoint&) override {}

  std::vector<Pose2> states_;
  std::vector<double> weights_;
  double share_ = 0.0;
};

class RecoveryTest : public testing::Test {
 protected:
  double after_one_scan(double log_odds, double probability) {
    const FoundElsewhere model(log_odds);
    RecoveryMemory memory;
    recovery_.observe(memory, 1, test::fake_measurement(1.0).payload, true);
    return recovery_.recover(memory, model, at(1.0), probability, filter_);
  }

  Recovery recovery_{RecoveryOptions{.active = true}, 1};
  Listener filter_;
};

TEST_F(RecoveryTest, WhatIsFoundGetsTheShareThatBayesGivesIt) {
  EXPECT_NEAR(after_one_scan(std::log(3.0), 0.4), 0.6 * 3.0 / (0.6 * 3.0 + 0.4), 1e-9);
  EXPECT_NEAR(filter_.share_, 0.6 * 3.0 / (0.6 * 3.0 + 0.4), 1e-9);
  double sum = 0.0;
  for (const double weight : filter_.weights_) sum += weight;
  EXPECT_NEAR(sum, 1.0, 1e-9);
  ASSERT_EQ(filter_.states_.size(), 300u);
  for (const Pose2& pose : filter_.states_) EXPECT_LT(distance(pose, FoundElsewhere::kPlace), 0.1);
}

TEST_F(RecoveryTest, ABeliefThatExplainsTheScansIsNotDisturbed) {
  EXPECT_EQ(after_one_scan(-20.0, 0.1), 0.0);
  EXPECT_TRUE(filter_.states_.empty());
}

TEST_F(RecoveryTest, WhoIsNotLostIsNotLookedFor) { EXPECT_EQ(after_one_scan(50.0, 0.9), 0.0); }

TEST_F(RecoveryTest, SearchesBecomeRareWhileTheyFindNothing) {
  const FoundElsewhere model(-20.0);
  RecoveryMemory memory;
  for (int i = 0; i < 600; ++i) {
    recovery_.observe(memory, 1, test::fake_measurement(0.1 * i).payload, true);
    recovery_.recover(memory, model, at(0.1 * i), 0.1, filter_);
  }
  EXPECT_GE(model.searches_, 28);
  EXPECT_LE(model.searches_, 34);  // at 0, 1, 3 s, then every 2
}

TEST_F(RecoveryTest, TheScansOfTheDoubtAreJoinedAsTheRobotMoved) {
  const FoundElsewhere model(-20.0);
  RecoveryMemory memory;
  const Pose2 step{0.3, 0.0, 0.1};
  recovery_.observe(memory, 1, test::fake_measurement(0.0).payload, false);  // before the doubt
  for (int i = 1; i <= 4; ++i) {
    Recovery::carry(memory, step);
    recovery_.observe(memory, 1, test::fake_measurement(i).payload, true);
  }
  recovery_.recover(memory, model, at(4.0), 0.1, filter_);
  ASSERT_EQ(model.glimpses_.size(), 4u);
  const Pose2 expected = inverse(step * step * step);
  EXPECT_LT(distance(model.glimpses_[0].T_now_then, expected), 1e-9);
  EXPECT_NEAR(model.glimpses_[0].T_now_then.theta, expected.theta, 1e-9);
  EXPECT_EQ(model.glimpses_[3].T_now_then.x, 0.0);
}

TEST_F(RecoveryTest, ScansNearToEachOtherAreNotJoinedTwice) {
  RecoveryMemory memory;
  for (int i = 0; i < 100; ++i) {
    Recovery::carry(memory, {0.05, 0.0, 0.0});
    recovery_.observe(memory, 1, test::fake_measurement(0.1 * i).payload, true);
  }
  EXPECT_LE(memory.glimpses.size(), 8u);
  EXPECT_LT(memory.glimpses.front().T_now_then.x, -0.8);
}

TEST_F(RecoveryTest, TheSameMeasurementsBringTheSamePosesIn) {
  after_one_scan(5.0, 0.3);
  const std::vector<Pose2> first = filter_.states_;
  after_one_scan(5.0, 0.3);
  EXPECT_EQ(first, filter_.states_);
}

}  // namespace
}  // namespace cairn
