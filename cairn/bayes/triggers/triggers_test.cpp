#include "cairn/bayes/triggers/triggers.hpp"

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/triggers/every_n_updates.hpp"
#include "cairn/bayes/triggers/fixed_rate.hpp"
#include "cairn/bayes/triggers/motion_thresholds.hpp"
#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

TEST(Trigger, EssRatio) {
  const EssRatio half(0.5), always(1.0), never(0.0);
  EXPECT_TRUE(half.due({.ess = 49.9, .particles = 100.0}));
  EXPECT_FALSE(half.due({.ess = 50.0, .particles = 100.0}));
  EXPECT_TRUE(always.due({.ess = 99.999, .particles = 100.0}));
  EXPECT_FALSE(never.due({.ess = 1.0, .particles = 100.0}));
}

TEST(Trigger, MotionThresholds) {
  const MotionThresholds trigger(0.2, 0.5);
  EXPECT_FALSE(trigger.due({.translation_m = 0.19, .rotation_rad = 0.49}));
  EXPECT_TRUE(trigger.due({.translation_m = 0.2}));
  EXPECT_TRUE(trigger.due({.rotation_rad = 0.5}));
}

TEST(Trigger, MotionAddsUpAlongThePath) {
  SinceLast since;
  since.add_motion(Pose2{0.3, 0.4, -0.2});
  since.add_motion(Pose2{-0.3, -0.4, 0.2});
  EXPECT_DOUBLE_EQ(since.translation_m, 1.0);
  EXPECT_DOUBLE_EQ(since.rotation_rad, 0.4);
  since.add_motion(42);  // a control that tells no distance
  EXPECT_DOUBLE_EQ(since.translation_m, 1.0);
}

TEST(Trigger, EveryNUpdates) {
  const EveryNUpdates trigger(3);
  EXPECT_FALSE(trigger.due({.updates = 2}));
  EXPECT_TRUE(trigger.due({.updates = 3}));
  EXPECT_TRUE(trigger.due({.updates = 4}));
}

TEST(Trigger, AFixedRateKeepsItsRateWhateverTheRateOfTheMeasurements) {
  const FixedRate trigger(3.0);
  for (const double spacing : {0.1, 0.07, 1.0 / 3.0}) {
    int fired = 0;
    SinceLast since{.last = at(1e9), .now = at(1e9)};
    for (int k = 1; k * spacing <= 100.0; ++k) {
      since.now = at(1e9 + k * spacing);
      if (!trigger.due(since)) continue;
      since.last = since.now;
      ++fired;
    }
    EXPECT_NEAR(fired, 300, 1) << spacing;
  }
  EXPECT_FALSE(trigger.due({.last = at(10.0), .now = at(9.0)}));  // the clock was set back
}

TEST(Trigger, EveryNameMakesOneAndOthersAreConfigurationErrors) {
  for (const std::string& name : trigger_names()) EXPECT_NE(make_trigger({.when = name}), nullptr);
  EXPECT_THROW(make_trigger({.when = "never"}), ConfigurationError);
}

// --- In the filter.

struct Stay final : MotionModel<Pose2, Pose2> {
  void propagate(const Pose2&, std::span<Pose2>, const RandomStream&) const override {}
};

// Measurements every 0.1 s while the robot drives 0.1 m each; returns the steps before which it resampled.
std::vector<int> resampled_before(const TriggerOptions& options) {
  using Filter = ParticleFilter<Pose2, Pose2>;
  Filter::Parts parts{.size = std::make_unique<FixedSize<Pose2>>(100),
                      .resample_when = make_trigger(options)};
  Filter filter(std::make_shared<const Stay>(), std::move(parts), std::make_shared<const Executor>(), {});
  filter.initialize([](const RandomStream&, std::uint32_t i) { return Pose2{0.01 * i, 0, 0}; });
  std::vector<int> steps;
  for (int k = 0; k < 12; ++k) {
    filter.predict({0.1, 0, 0});
    if (filter.ess() == 100.0 && k > 0) steps.push_back(k);
    filter.correct({at(100.05 + 0.1 * k), [](std::span<const Pose2> poses, std::span<double> out) {
                      for (std::size_t i = 0; i < out.size(); ++i) out[i] = 0.5 * poses[i].x;
                    }});
  }
  return steps;
}

TEST(Trigger, DecidesWhenAFilterResamples) {
  EXPECT_EQ(resampled_before({.when = "updates", .every_n = 5}), (std::vector<int>{5, 10}));
  EXPECT_EQ(resampled_before({.when = "updates", .every_n = 1}).size(), 11u);
  // 0.4 m have been driven with the control of step 3; the account begins anew with that of step 4.
  EXPECT_EQ(resampled_before({.when = "motion", .min_translation_m = 0.35, .min_rotation_rad = 1.0}),
            (std::vector<int>{4, 8}));
  EXPECT_EQ(resampled_before({.when = "rate", .rate_hz = 2.0}), (std::vector<int>{1, 6, 11}));
  EXPECT_EQ(resampled_before({.when = "ess", .ess_ratio = 1.0}).size(), 11u);
  EXPECT_EQ(resampled_before({.when = "ess", .ess_ratio = 0.0}).size(), 0u);
}

}  // namespace
}  // namespace cairn
