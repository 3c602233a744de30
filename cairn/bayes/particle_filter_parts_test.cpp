// The seams of the particle filter: checkpoints, single steps, and its exchangeable parts.
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

struct NoisyMove final : MotionModel<Pose2, Pose2> {
  void propagate(const Pose2& u, std::span<Pose2> states, const RandomStream& random) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(i));
      states[i] = states[i] * u * Pose2{0.02 * n[0], 0.02 * n[1], 0.02 * n[2]};
    }
  }
};

BoundUpdate<Pose2> near_to(const Pose2& truth, double sigma) {
  return {Time{}, [=](std::span<const Pose2> poses, std::span<double> out) {
            for (std::size_t i = 0; i < poses.size(); ++i) {
              const double d = std::hypot(poses[i].x - truth.x, poses[i].y - truth.y,
                                          angle_difference(poses[i].theta, truth.theta));
              out[i] = -d * d / (2.0 * sigma * sigma);
            }
          }};
}

// Brings ever more particles: remembers how many.
struct Rising final : Injection<Pose2> {
  std::size_t next = 0;
  double last_log_mean = 0.0;
  std::size_t wanted(const BoundUpdate<Pose2>&, double log_mean_likelihood, std::size_t n) override {
    last_log_mean = log_mean_likelihood;
    return std::min(next++, n);
  }
  void sample(const BoundUpdate<Pose2>&, std::span<Pose2> states, const RandomStream& random) const override {
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i] = {100.0 + random.normal4(static_cast<std::uint32_t>(i))[0], 0.0, 0.0};
  }
  void save(PartMemory& memory) const override { memory.put(static_cast<double>(next)); }
  void load(PartMemory::Reader& memory) override { next = static_cast<std::size_t>(memory.take()); }
};

using Filter = ParticleFilter<Pose2, Pose2>;

Filter filter_with(Filter::Parts parts, const ParticleFilterOptions& options, int threads = 1) {
  Filter filter(std::make_shared<const NoisyMove>(), std::move(parts),
                std::make_shared<const Executor>(threads), options);
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.3 * n[0], 0.3 * n[1], 0.1 * n[2]};
  });
  return filter;
}

Filter::Parts fixed(std::size_t particles) { return {.size = std::make_unique<FixedSize<Pose2>>(particles)}; }

// Every part that remembers something, and one that is not compact at times.
Filter full_filter(int threads = 1) {
  PoseKernelOptions kernel;
  kernel.largest_spread_m = 0.2;
  return filter_with({.size = std::make_unique<KldSize>(KldOptions{}, 200, 3000),
                      .regularization = std::make_unique<PoseKernel>(kernel),
                      .injection = std::make_unique<Rising>()},
                     {.seed = 3, .resample_ess_ratio = 0.8, .min_ess_share = 0.15}, threads);
}

void expect_same_bytes(const Filter& a, const Filter& b) {
  const auto& p = a.particles();
  const auto& q = b.particles();
  ASSERT_EQ(p.size(), q.size());
  EXPECT_EQ(std::memcmp(p.states.data(), q.states.data(), p.size() * sizeof(Pose2)), 0);
  EXPECT_EQ(std::memcmp(p.log_weights.data(), q.log_weights.data(), p.size() * sizeof(double)), 0);
  EXPECT_EQ(a.ess(), b.ess());
  EXPECT_EQ(a.compact(), b.compact());
  EXPECT_EQ(a.share_entered(), b.share_entered());
}

// Predictions and corrections in a mixed order; step k of the same drive for every filter.
void drive(Filter& filter, int from, int to) {
  for (int k = from; k < to; ++k) {
    if (k % 3 != 2) filter.predict({0.1, 0.0, 0.02});
    if (k % 4 != 1) filter.correct(near_to({0.07 * k, 0.0, 0.01 * k}, k % 5 == 0 ? 0.02 : 0.3));
  }
}

TEST(ParticleFilterCheckpoint, WhatFollowsIsTheSameToTheByteFromAnyStep) {
  constexpr int kSteps = 14;
  Filter straight = full_filter();
  drive(straight, 0, kSteps);
  for (int at = 0; at <= kSteps; ++at) {
    Filter filter = full_filter();
    drive(filter, 0, at);
    const auto checkpoint = filter.checkpoint();
    drive(filter, at, at + 5);  // a wrong future
    filter.restore(checkpoint);
    drive(filter, at, kSteps);
    expect_same_bytes(filter, straight);
    Filter other = full_filter(2);  // another process, say
    other.restore(checkpoint);
    drive(other, at, kSteps);
    expect_same_bytes(other, straight);
  }
}

TEST(ParticleFilterCheckpoint, AUsedBufferIsOverwritten) {
  Filter filter = full_filter();
  Filter::Checkpoint buffer;
  drive(filter, 0, 9);
  filter.save(buffer);
  drive(filter, 9, 12);
  filter.save(buffer);
  Filter copy = full_filter();
  copy.restore(buffer);
  expect_same_bytes(copy, filter);
}

TEST(ParticleFilterSteps, AnUpdateIsAPredictionAndACorrection) {
  Filter whole = full_filter(), parts = full_filter();
  for (int k = 0; k < 5; ++k) {
    const auto z = near_to({0.1 * k, 0, 0}, 0.1);
    whole.update({0.1, 0, 0}, z);
    parts.predict({0.1, 0, 0});
    parts.correct(z);
  }
  expect_same_bytes(whole, parts);
}

// Weights multiply: two measurements at once weigh like their product. (Without portions and resampling,
// nothing random happens in a correction.)
TEST(ParticleFilterSteps, TwoMeasurementsOfTheSameTimeWeighLikeTheirProduct) {
  const Pose2 a{0.1, 0, 0}, b{0.3, 0.1, 0.1};
  Filter two = filter_with(fixed(500), {}), product = filter_with(fixed(500), {});
  two.predict({0.1, 0, 0});
  two.correct(near_to(a, 0.5));
  two.correct(near_to(b, 0.7));
  product.update({0.1, 0, 0}, {Time{}, [&](std::span<const Pose2> poses, std::span<double> out) {
                                 std::vector<double> more(poses.size());
                                 near_to(a, 0.5).log_likelihood(poses, out);
                                 near_to(b, 0.7).log_likelihood(poses, more);
                                 for (std::size_t i = 0; i < out.size(); ++i) out[i] += more[i];
                               }});
  EXPECT_EQ(two.particles().states, product.particles().states);
  for (std::size_t i = 0; i < 500; ++i)
    EXPECT_NEAR(two.particles().log_weights[i], product.particles().log_weights[i], 1e-9);
  EXPECT_NEAR(two.ess(), product.ess(), 1e-6);
}

TEST(ParticleFilterSteps, PredictionsWithoutMeasurementsSpreadTheBelief) {
  Filter filter = filter_with(fixed(2000), {});
  for (int k = 0; k < 100; ++k) filter.predict({});
  double squares = 0.0;
  for (const Pose2& p : filter.particles().states) squares += p.y * p.y / 2000.0;
  // 0.3^2 + 100 * 0.02^2; the variance of 2000 normal numbers is within 4.9 * sqrt(2 / 2000) of it.
  EXPECT_NEAR(squares, 0.13, 0.13 * 4.9 * std::sqrt(2.0 / 2000.0));
  EXPECT_EQ(filter.ess(), 2000.0);
}

// Records the random numbers that each drawing would use.
struct RecordingResampling final : Resampling {
  std::shared_ptr<std::multiset<double>> numbers;
  void draw(std::span<const double>, std::size_t count, const DrawingNumbers& n,
            std::vector<std::uint32_t>& ancestors) override {
    numbers->insert(n.single());
    numbers->insert(n.start());
    for (std::uint32_t i = 0; i < count; ++i) numbers->insert(n.of_particle(i));
    ancestors.insert(ancestors.end(), count, 0);
  }
};

TEST(ParticleFilterParts, NoTwoDrawingsShareARandomNumber) {
  auto resampling = std::make_unique<RecordingResampling>();
  const auto numbers = resampling->numbers = std::make_shared<std::multiset<double>>();
  PoseKernelOptions always_compact;
  always_compact.largest_spread_m = 1e6;
  Filter filter = filter_with({.size = std::make_unique<KldSize>(KldOptions{}, 50, 2000),
                               .resampling = std::move(resampling),
                               .regularization = std::make_unique<PoseKernel>(always_compact),
                               .injection = std::make_unique<Rising>()},
                              {.seed = 1, .resample_ess_ratio = 1.0, .min_ess_share = 0.5});
  for (int k = 0; k < 3; ++k) {
    filter.predict({0.1, 0, 0});
    filter.correct(near_to({1, 0, 0}, 0.001));
    filter.correct(near_to({0, 1, 0}, 0.001));
  }
  EXPECT_GT(numbers->size(), 3000u);
  // 32-bit numbers: n^2 / 2^33 coincidences are expected by chance.
  const std::set<double> different(numbers->begin(), numbers->end());
  EXPECT_GE(different.size() + 10, numbers->size());
}

// Puts each particle onto the truth and tells the density ratio: exp(-id).
struct Teleport final : Refinement<Pose2> {
  void refine(const BoundUpdate<Pose2>&, ParticleSet<Pose2>& particles, const RandomStream&,
              const Executor&) override {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.states[i] = {1.0, 2.0, 0.0};
      particles.log_weights[i] -= static_cast<double>(i);
    }
  }
};

TEST(ParticleFilterParts, RefinementMovesBeforeTheWeighingAndItsDensityRatioCounts) {
  auto parts = fixed(50);
  parts.refinement = std::make_unique<Teleport>();
  Filter filter = filter_with(std::move(parts), {});
  filter.update({}, near_to({1.0, 2.0, 0.0}, 0.01));
  for (const Pose2& p : filter.particles().states) EXPECT_EQ(p, (Pose2{1.0, 2.0, 0.0}));
  const auto& w = filter.particles().log_weights;
  EXPECT_NEAR(log_sum_exp(w), 0.0, 1e-12);
  for (std::size_t i = 1; i < w.size(); ++i) EXPECT_NEAR(w[i - 1] - w[i], 1.0, 1e-12);
}

std::size_t injected(const Filter& filter) {
  const auto& states = filter.particles().states;
  return static_cast<std::size_t>(
      std::count_if(states.begin(), states.end(), [](const Pose2& p) { return p.x > 50.0; }));
}

TEST(ParticleFilterParts, InjectionReplacesAsManyAsItWants) {
  auto parts = fixed(300);
  parts.injection = std::make_unique<Rising>();
  Filter filter = filter_with(std::move(parts), {});
  for (std::size_t wanted = 0; wanted < 4; ++wanted) {
    filter.update({}, near_to({}, 1.0));  // removes what was injected before
    EXPECT_EQ(injected(filter), wanted);
    EXPECT_EQ(filter.particles().size(), 300u);
    EXPECT_EQ(filter.ess(), wanted == 0 ? filter.ess() : 300.0);
    EXPECT_NEAR(log_sum_exp(filter.particles().log_weights), 0.0, 1e-12);
  }
}

// The mean is that of the unnormalised likelihood, whatever the number of particles and whatever is tempered.
TEST(ParticleFilterParts, InjectionIsToldTheMeanLikelihoodPerParticle) {
  for (const std::size_t n : {100u, 1000u}) {
    for (const double min_ess_share : {0.0, 0.5}) {
      auto parts = fixed(n);
      auto rising = std::make_unique<Rising>();
      const Rising& injection = *rising;
      parts.injection = std::move(rising);
      Filter filter = filter_with(std::move(parts), {.min_ess_share = min_ess_share});
      filter.update({}, {Time{}, [](std::span<const Pose2> poses, std::span<double> out) {
                           // Far below what exp() can hold; half the particles see e^-1000, the others
                           // nothing.
                           for (std::size_t i = 0; i < out.size(); ++i)
                             out[i] = poses[i].x < 0 ? -1000. : -5000.;
                         }});
      const auto& states = filter.particles().states;
      const auto seeing = std::count_if(states.begin(), states.end(), [](const Pose2& p) { return p.x < 0; });
      EXPECT_NEAR(injection.last_log_mean,
                  -1000.0 + std::log(static_cast<double>(seeing) / static_cast<double>(n)), 1e-9);
    }
  }
}

}  // namespace
}  // namespace cairn
