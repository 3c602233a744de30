// Against exact answers: tests/statistical/particle_filter_oracles_test.cpp.
#include "cairn/bayes/particle_filter.hpp"

#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two-sided bound of a standard normal number with false-alarm probability 1e-6.
constexpr double kAlarm = 4.892;

template <class State>
BoundUpdate<State> measurement(std::function<double(const State&)> log_p) {
  return {Time{}, [log_p](std::span<const State> states, std::span<double> out) {
            std::transform(states.begin(), states.end(), out.begin(), log_p);
          }};
}

template <class State, class Control, class Motion>
ParticleFilter<State, Control> filter_with(Motion motion, std::size_t particles,
                                           const ParticleFilterOptions& options) {
  return {std::make_shared<const Motion>(std::move(motion)), std::make_unique<FixedSize<State>>(particles),
          nullptr, std::make_shared<const Executor>(), options};
}

template <class State>
double expectation(const ParticleSet<State>& particles, const std::function<double(const State&)>& f) {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    sum += std::exp(particles.log_weights[i]) * f(particles.states[i]);
  return sum;
}

// --- The tutorial's door: a state that is no pose, probabilities known exactly.

enum class Door { kOpen, kClosed };
enum class Action { kNothing, kClose };

struct DoorMotion final : MotionModel<Door, Action> {
  void propagate(const Action& u, std::span<Door> doors, const RandomStream& random) const override {
    for (std::size_t i = 0; i < doors.size(); ++i) {
      const bool closes = u == Action::kClose && random.uniform(static_cast<std::uint32_t>(i)) < 0.9;
      if (closes) doors[i] = Door::kClosed;
    }
  }
};

BoundUpdate<Door> door_seen(double p_if_open, double p_if_closed) {
  return measurement<Door>(
      [=](const Door& d) { return std::log(d == Door::kOpen ? p_if_open : p_if_closed); });
}

double p_open(const ParticleFilter<Door, Action>& filter) {
  return expectation<Door>(filter.particles(), [](Door d) { return d == Door::kOpen ? 1.0 : 0.0; });
}

constexpr std::size_t kDoors = 100'000;

ParticleFilter<Door, Action> door_filter(double resample_ess_ratio) {
  auto filter = filter_with<Door, Action>(DoorMotion{}, kDoors, {7, resample_ess_ratio, 0.0});
  // Sorted: a comb over alternating doors would beat against their order and draw one kind too often.
  filter.initialize(
      [](const RandomStream&, std::uint32_t i) { return i < kDoors / 2 ? Door::kOpen : Door::kClosed; });
  return filter;
}

TEST(ParticleFilter, TheDoorOfTheTutorialExactlyWhereNothingIsSampled) {
  auto filter = door_filter(0.0);
  EXPECT_NEAR(p_open(filter), 0.5, 1e-10);
  filter.update(Action::kNothing, door_seen(0.6, 0.3));
  EXPECT_NEAR(p_open(filter), 2.0 / 3.0, 1e-10);
  filter.update(Action::kNothing, door_seen(0.5, 0.6));
  EXPECT_NEAR(p_open(filter), 5.0 / 8.0, 1e-10);
  // 5/8 times the share of kDoors/2 open doors that stay open, binomial with p = 0.1.
  filter.update(Action::kClose, door_seen(1.0, 1.0));
  const double bound = kAlarm * 5.0 / 8.0 * std::sqrt(0.09 / (kDoors / 2.0));
  EXPECT_NEAR(p_open(filter), 1.0 / 16.0, bound);
  EXPECT_NEAR(1.0 - p_open(filter), 15.0 / 16.0, bound);
}

TEST(ParticleFilter, TheDoorOfTheTutorialWithResampling) {
  auto filter = door_filter(1.0);
  filter.update(Action::kNothing, door_seen(0.6, 0.3));
  EXPECT_NEAR(p_open(filter), 2.0 / 3.0, 1e-10);
  // The comb draws each kind within one door of its expectation.
  filter.update(Action::kNothing, door_seen(0.5, 0.6));
  EXPECT_NEAR(p_open(filter), 5.0 / 8.0, 2.0 / kDoors);
  filter.update(Action::kClose, door_seen(1.0, 1.0));
  EXPECT_NEAR(p_open(filter), 1.0 / 16.0, kAlarm * std::sqrt(0.09 * 5.0 / 8.0 / kDoors) + 2.0 / kDoors);
}

// --- Which particles survive.

struct Stay final : MotionModel<int, int> {
  void propagate(const int&, std::span<int>, const RandomStream&) const override {}
};

std::set<int> survivors(double resample_ess_ratio, const BoundUpdate<int>& z) {
  auto filter = filter_with<int, int>(Stay{}, 300, {1, resample_ess_ratio, 0.0});
  filter.initialize([](const RandomStream&, std::uint32_t i) { return static_cast<int>(i); });
  filter.update(0, z);
  filter.update(0, z);
  const auto& states = filter.particles().states;
  return {states.begin(), states.end()};
}

TEST(ParticleFilter, ResamplesByTheEffectiveSampleSize) {
  const auto half = measurement<int>([](const int& id) { return id < 150 ? 0.0 : -50.0; });  // ESS = N/2
  EXPECT_EQ(survivors(0.0, half).size(), 300u);
  EXPECT_EQ(survivors(0.49, half).size(), 300u);
  EXPECT_EQ(survivors(0.51, half).size(), 150u);
  EXPECT_EQ(*survivors(0.51, half).rbegin(), 149);
  const auto flat = measurement<int>([](const int&) { return -3.0; });
  EXPECT_EQ(survivors(1.0, flat).size(), 300u);
}

/// Leaves unequal weights behind, as clustered resampling does.
struct LeavesWeights final : Resampling {
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override {
    ++drawings;
    draw_systematic(cumulative, count, numbers.single(), ancestors);
  }
  bool weigh_drawn(std::span<double> log_weights) override {
    log_weights[0] += 5.0;
    return true;
  }
  int drawings = 0;
};

TEST(ParticleFilter, DrawsOnceAfterAMeasurementHoweverOftenItPredicts) {
  auto resampling = std::make_unique<LeavesWeights>();
  const LeavesWeights& counted = *resampling;
  ParticleFilter<int, int> filter(
      std::make_shared<const Stay>(),
      {.size = std::make_unique<FixedSize<int>>(10), .resampling = std::move(resampling)},
      std::make_shared<const Executor>(), {.resample_ess_ratio = 0.9});
  filter.initialize([](const RandomStream&, std::uint32_t i) { return static_cast<int>(i); });
  filter.update(0, measurement<int>([](const int& i) { return i < 2 ? 0.0 : -9.0; }));
  for (int i = 0; i < 3; ++i) filter.predict(0);
  EXPECT_EQ(counted.drawings, 1);
  filter.correct(measurement<int>([](const int&) { return 0.0; }));
  filter.predict(0);
  EXPECT_EQ(counted.drawings, 2);
}

TEST(ParticleFilter, EffectiveSampleSizeAndWeightsAfterAMeasurement) {
  auto filter = filter_with<int, int>(Stay{}, 300, {});
  filter.initialize([](const RandomStream&, std::uint32_t i) { return static_cast<int>(i); });
  EXPECT_EQ(filter.ess(), 300.0);
  filter.update(0, measurement<int>([](const int& id) { return id < 100 ? 1e4 : 1e4 - 1000.0; }));
  EXPECT_NEAR(filter.ess(), 100.0, 1e-9);
  EXPECT_NEAR(std::exp(log_sum_exp(filter.particles().log_weights)), 1.0, 1e-12);
  EXPECT_EQ(filter.share_entered(), 1.0);
  EXPECT_FALSE(filter.compact());  // no regularization tells
}

// --- Numbers of particles.

// Asks for 10, 95, then 100 particles: the last batch is smaller than the smallest that the filter draws.
struct NearlyMost final : SampleSize<int> {
  std::size_t total = 0;
  std::size_t begin() override { return total = 10; }
  std::size_t wanted(std::span<const int>) override { return total = total == 10 ? 95 : 100; }
  std::size_t most() const override { return 100; }
};

TEST(ParticleFilter, NeverHasMoreParticlesThanTheMost) {
  ParticleFilter<int, int> filter(std::make_shared<const Stay>(), std::make_unique<NearlyMost>(), nullptr,
                                  std::make_shared<const Executor>(), {});
  filter.initialize([](const RandomStream&, std::uint32_t i) { return static_cast<int>(i); });
  for (int i = 0; i < 3; ++i) {
    filter.update(0, measurement<int>([](const int& id) { return -0.1 * id; }));
    EXPECT_EQ(filter.particles().size(), 100u);
    EXPECT_EQ(filter.particles().log_weights.size(), filter.particles().size());
  }
}

// Moves forward with noise in all coordinates that the control gives.
struct NoisyMove final : MotionModel<Pose2, double> {
  void propagate(const double& sigma, std::span<Pose2> states, const RandomStream& random) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(i));
      states[i] = states[i] * Pose2{0.1 + sigma * n[0], sigma * n[1], sigma * n[2]};
    }
  }
};

BoundUpdate<Pose2> near_to(const Pose2& truth, double sigma) {
  return measurement<Pose2>([=](const Pose2& p) {
    const double dx = p.x - truth.x, dy = p.y - truth.y, dt = angle_difference(p.theta, truth.theta);
    return -(dx * dx + dy * dy + dt * dt) / (2.0 * sigma * sigma);
  });
}

using PoseFilter = ParticleFilter<Pose2, double>;

PoseFilter kld_filter(int threads, std::uint64_t seed = 1) {
  PoseFilter filter(std::make_shared<const NoisyMove>(), std::make_unique<KldSize>(KldOptions{}, 200, 5000),
                    std::make_unique<PoseKernel>(PoseKernelOptions{}),
                    std::make_shared<const Executor>(threads), {seed, 1.0, 0.15});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.05 * n[0], 0.05 * n[1], 0.02 * n[2]};
  });
  return filter;
}

std::size_t occupied_bins(const std::vector<Pose2>& states) {
  const PoseBins bins{KldOptions{}};
  std::set<std::uint64_t> keys;
  for (const Pose2& p : states) keys.insert(bins.key(p));
  return keys.size();
}

TEST(ParticleFilter, KldGrowsInTheVeryStepThatSpreadsTheBelief) {
  PoseFilter filter = kld_filter(1);
  const auto vague = near_to({0.1, 0, 0}, 2.0);  // never enough to contract the belief
  filter.update(0.01, vague);
  const std::size_t compact = filter.particles().size();
  filter.update(0.5, vague);
  const std::size_t spread = filter.particles().size();
  EXPECT_GT(spread, 3 * compact);
  EXPECT_GE(spread, std::min<std::size_t>(5000, kld_bound(occupied_bins(filter.particles().states), {})));
}

TEST(ParticleFilter, KldShrinksAgainAndKeepsItsLimits) {
  PoseFilter filter = kld_filter(1);
  filter.update(0.01, near_to({0.1, 0, 0}, 2.0));
  filter.update(3.0, near_to({0.2, 0, 0}, 5.0));
  EXPECT_EQ(filter.particles().size(), 5000u);
  for (int i = 0; i < 6; ++i) filter.update(0.01, near_to({1.0 + 0.1 * i, 0, 0}, 0.1));
  EXPECT_LT(filter.particles().size(), 500u);
  EXPECT_GE(filter.particles().size(), 200u);
}

// Never compact before a measurement, always after it: all kinds of moves happen. Records their draws.
struct RecordingKernel final : Regularization<Pose2> {
  std::shared_ptr<std::vector<std::uint16_t>> draws;
  bool compact = true;
  bool fit(const ParticleSet<Pose2>& particles) override {
    compact = particles.log_weights.front() != particles.log_weights.back() ? !compact : false;
    return compact;
  }
  void move(std::span<Pose2>, const RandomStream&, std::uint16_t draw) const override {
    draws->push_back(draw);
  }
};

// The offsets of the combs are draw 0 of the same random stream.
TEST(ParticleFilter, NoTwoMovesOrCombsOfAStepShareTheirRandomNumbers) {
  auto kernel = std::make_unique<RecordingKernel>();
  const auto draws = kernel->draws = std::make_shared<std::vector<std::uint16_t>>();
  PoseFilter filter(std::make_shared<const NoisyMove>(), std::make_unique<FixedSize<Pose2>>(100),
                    std::move(kernel), std::make_shared<const Executor>(), {1, 1.0, 0.5});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    return Pose2{random.normal4(i)[0], 0, 0};
  });
  std::size_t most = 0;
  for (int step = 0; step < 6; ++step) {
    draws->clear();
    filter.update(0.1, near_to({0, 0, 0}, 0.05));
    const std::set<std::uint16_t> different(draws->begin(), draws->end());
    EXPECT_EQ(different.size(), draws->size()) << step;
    EXPECT_FALSE(different.contains(0)) << step;
    most = std::max(most, draws->size());
  }
  EXPECT_GE(most, 2u);  // both kinds happened in one step
}

// --- Reproducibility.

bool same_bytes(const PoseFilter& a, const PoseFilter& b) {
  const auto& p = a.particles();
  const auto& q = b.particles();
  return p.size() == q.size() &&
         std::memcmp(p.states.data(), q.states.data(), p.size() * sizeof(Pose2)) == 0 &&
         std::memcmp(p.log_weights.data(), q.log_weights.data(), p.size() * sizeof(double)) == 0;
}

PoseFilter after_a_drive(int threads, std::uint64_t seed) {
  PoseFilter filter = kld_filter(threads, seed);
  for (int i = 0; i < 8; ++i) filter.update(i == 3 ? 1.0 : 0.05, near_to({0.1 * i, 0.02 * i, 0.0}, 0.1));
  return filter;
}

TEST(ParticleFilter, TheSameBytesForAnyNumberOfThreads) {
  const PoseFilter one = after_a_drive(1, 5);
  EXPECT_TRUE(same_bytes(one, after_a_drive(1, 5)));
  EXPECT_TRUE(same_bytes(one, after_a_drive(2, 5)));
  EXPECT_TRUE(same_bytes(one, after_a_drive(7, 5)));
  EXPECT_FALSE(same_bytes(one, after_a_drive(1, 6)));
}

// --- Progressive correction: a likelihood a hundred times narrower than the prior.

const Pose2 kTruth{0.4, -0.3, 0.2};

PoseFilter corrected(std::uint64_t seed, double min_ess_share, bool with_kernel) {
  PoseFilter filter(std::make_shared<const NoisyMove>(), std::make_unique<FixedSize<Pose2>>(500),
                    with_kernel ? std::make_unique<PoseKernel>(PoseKernelOptions{}) : nullptr,
                    std::make_shared<const Executor>(), {seed, 1.0, min_ess_share});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.3 * n[0] - 0.1, 0.3 * n[1], 0.3 * n[2]};
  });
  filter.update(0.0, near_to(kTruth, 0.01));
  return filter;
}

double error_of(const PoseFilter& filter) {
  std::vector<double> weights;
  for (const double w : filter.particles().log_weights) weights.push_back(std::exp(w));
  const Pose2 mean = weighted_moments(filter.particles().states, weights).mean;
  return std::hypot(mean.x - kTruth.x, mean.y - kTruth.y, angle_difference(mean.theta, kTruth.theta));
}

TEST(ParticleFilter, ProgressiveCorrectionFindsWhatOneWeighingMisses) {
  double worst_progressive = 0.0, mean_single = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PoseFilter progressive = corrected(seed, 0.15, true);
    EXPECT_EQ(progressive.share_entered(), 1.0) << seed;
    EXPECT_GE(progressive.ess(), 0.15 * 500.0) << seed;
    worst_progressive = std::max(worst_progressive, error_of(progressive));
    mean_single += error_of(corrected(seed, 0.0, true)) / 10.0;
  }
  EXPECT_LT(worst_progressive, 0.01);  // one standard deviation of the measurement
  EXPECT_GT(mean_single, 0.04);        // the best of 500 particles is that far off
}

TEST(ParticleFilter, WithoutAKernelOnePortionEntersAndSaysSo) {
  const PoseFilter filter = corrected(1, 0.15, false);
  EXPECT_LT(filter.share_entered(), 0.1);
  EXPECT_GT(filter.share_entered(), 0.0);
  EXPECT_GE(filter.ess(), 0.15 * 500.0);
}

TEST(ParticleFilter, ABeliefOfTwoPlacesGetsOnePortionOnly) {
  PoseFilter filter = kld_filter(1);
  filter.update(0.01, near_to({0, 0, 0}, 2.0));
  filter.update(3.0, measurement<Pose2>([](const Pose2& p) {
                  const double d = (std::abs(p.x) - 5.0) / 0.05;
                  return -d * d / 2.0;
                }));
  EXPECT_FALSE(filter.compact());
  EXPECT_LT(filter.share_entered(), 0.1);
  EXPECT_GE(filter.ess(), 0.15 * 5000.0 * 0.999);
}

}  // namespace
}  // namespace cairn
