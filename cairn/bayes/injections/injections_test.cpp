#include "cairn/bayes/injections/injections.hpp"

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using Line = double;  ///< a position on a line

class StandStill final : public MotionModel<Line, double> {
 public:
  void propagate(const double&, std::span<Line>, const RandomStream&) const override {}
};

/// p(x | z) as if the sensor said exactly where.
class Exactly final : public SampleFrom<Line> {
 public:
  explicit Exactly(double where) : where_(where) {}
  void sample(const BoundUpdate<Line>&, std::span<Line> states, const RandomStream&) const override {
    std::fill(states.begin(), states.end(), where_);
  }

 private:
  double where_;
};

// Like a scan of `beams` beams at `truth`, of which each has the likelihood 0.85 exp(-d^2 / 2) + 0.15.
BoundUpdate<Line> scan_at(double truth, double beams) {
  return {{}, [=](std::span<const Line> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i) {
              const double d = states[i] - truth;
              out[i] = beams * std::log(0.85 * std::exp(-d * d / 2.0) + 0.15);
            }
          }};
}

ParticleFilter<Line, double> filter_with(std::unique_ptr<Injection<Line>> injection, std::size_t particles) {
  ParticleFilterParts<Line> parts{.size = std::make_unique<FixedSize<Line>>(particles)};
  parts.injection = std::move(injection);
  return {std::make_shared<const StandStill>(), std::move(parts), std::make_shared<const Executor>(), {}};
}

std::unique_ptr<Injection<Line>> augmented(double beams) {
  return std::make_unique<Augmented<Line>>(AugmentedOptions{}, beams, std::make_shared<const Exactly>(7.0));
}

void start_at_zero(ParticleFilter<Line, double>& filter) {
  filter.initialize([](const RandomStream& random, std::uint32_t i) { return 0.1 * random.normal4(i)[0]; });
}

double share_at_seven(const ParticleFilter<Line, double>& filter) {
  double share = 0.0;
  for (std::size_t i = 0; i < filter.particles().size(); ++i) {
    if (filter.particles().states[i] == 7.0) share += std::exp(filter.particles().log_weights[i]);
  }
  return share;
}

// Particles that came while the robot was carried from 0 to 7: after `steps` measurements there.
double recovered(std::size_t particles, double beams, int steps) {
  auto filter = filter_with(augmented(beams), particles);
  start_at_zero(filter);
  for (int i = 0; i < 50; ++i) filter.update(0.0, scan_at(0.0, beams));
  EXPECT_EQ(share_at_seven(filter), 0.0);  // not one while all is well
  for (int i = 0; i < steps; ++i) filter.update(0.0, scan_at(7.0, beams));
  return share_at_seven(filter);
}

// Others average weights that sum to 1: those never fall, and the robot is never found again.
TEST(Augmented, RecoversFromKidnapping) { EXPECT_GT(recovered(500, 20.0, 5), 0.95); }

// Others compare averages that carry a factor 1 / N, or the likelihood of all beams to the power of their
// number.
TEST(Augmented, InjectsTheSameShareForAnyNumberOfParticlesAndBeams) {
  const auto first_injection = [](std::size_t particles, double beams) {
    Augmented<Line> rule(AugmentedOptions{}, beams, nullptr);
    const auto measure = [&](double per_beam) {
      return static_cast<double>(rule.wanted({}, beams * std::log(per_beam), particles)) /
             static_cast<double>(particles);
    };
    for (int i = 0; i < 20; ++i) EXPECT_EQ(measure(0.9), 0.0);
    return measure(0.2);
  };
  const double expected = first_injection(1000, 20.0);
  EXPECT_NEAR(expected, 1.0 - (0.9 - 0.2 * 0.7) / (0.9 - 0.002 * 0.7), 1e-3);  // table 8.3 by hand
  EXPECT_NEAR(first_injection(100000, 20.0), expected, 1e-3);
  EXPECT_NEAR(first_injection(1000, 360.0), expected, 1e-3);
  EXPECT_NEAR(first_injection(1000, 1.0), expected, 1e-3);
}

TEST(Augmented, TheAveragesBeginAtTheFirstLikelihood) {
  Augmented<Line> rule(AugmentedOptions{}, 20.0, nullptr);
  EXPECT_EQ(rule.wanted({}, -30.0, 1000), 0u);  // bad, but there was nothing better before
}

TEST(Augmented, ItsAveragesComeBack) {
  Augmented<Line> rule(AugmentedOptions{}, 20.0, nullptr), other(AugmentedOptions{}, 20.0, nullptr);
  rule.wanted({}, -2.0, 1000);
  PartMemory memory;
  rule.save(memory);
  PartMemory::Reader reader(memory);
  other.load(reader);
  EXPECT_EQ(other.wanted({}, -30.0, 1000), rule.wanted({}, -30.0, 1000));
  EXPECT_GT(rule.wanted({}, -30.0, 1000), 0u);
}

TEST(Augmented, RefusesAveragesInTheWrongOrder) {
  AugmentedOptions options;
  options.alpha_slow = 0.5;
  EXPECT_THROW(options.validate(), ConfigurationError);
}

TEST(SensorResetting, FollowsEquationOne) {
  SensorResetting<Line> rule({.threshold = 0.4}, 10.0, nullptr);
  EXPECT_EQ(rule.wanted({}, 10.0 * std::log(0.4), 1000), 0u);
  EXPECT_EQ(rule.wanted({}, 10.0 * std::log(0.9), 1000), 0u);  // clamped
  EXPECT_NEAR(static_cast<double>(rule.wanted({}, 10.0 * std::log(0.3), 1000)), 250.0, 1.0);
  EXPECT_EQ(rule.wanted({}, -1e9, 1000), 1000u);
}

TEST(NewFromMeasurement, ReplacesTheGrowth) {
  NewFromMeasurement<Line> rule(nullptr);
  EXPECT_EQ(rule.wanted({}, 0.0, 500), 0u);
  EXPECT_EQ(rule.wanted({}, 0.0, 700), 200u);
  EXPECT_EQ(rule.wanted({}, 0.0, 600), 0u);
  EXPECT_EQ(rule.wanted({}, 0.0, 650), 50u);
}

TEST(OnlyWithOneCluster, ReplacesNothingWhileThereAreSeveral) {
  const auto table = std::make_shared<ClusterTable>();
  OnlyWithOneCluster<Line> rule(
      table, std::make_unique<SensorResetting<Line>>(SensorResettingOptions{}, 10.0, nullptr));
  table->clusters = 2;
  EXPECT_EQ(rule.wanted({}, -1e9, 1000), 0u);
  table->clusters = 1;
  EXPECT_EQ(rule.wanted({}, -1e9, 1000), 1000u);
}

}  // namespace
}  // namespace cairn
