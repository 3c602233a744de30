#include "cairn/bayes/gradient_refinement.hpp"

#include "cairn/bayes/kernel_density.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kSigma_m = 0.05, kSigma_rad = 0.02;

// A Gaussian measurement of the pose.
BoundUpdate<Pose2> measurement_of(const Pose2& truth, double sign = 1.0) {
  BoundUpdate<Pose2> z;
  z.log_likelihood = [=](std::span<const Pose2> states, std::span<double> out) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double dx = states[i].x - truth.x, dy = states[i].y - truth.y;
      const double turn = normalize_angle(states[i].theta - truth.theta);
      out[i] = -(dx * dx + dy * dy) / (2 * kSigma_m * kSigma_m) - turn * turn / (2 * kSigma_rad * kSigma_rad);
    }
  };
  z.gradient = [=](std::span<const Pose2> states, std::span<Eigen::Vector3d> out) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      out[i] =
          -sign * Eigen::Vector3d((states[i].x - truth.x) / (kSigma_m * kSigma_m),
                                  (states[i].y - truth.y) / (kSigma_m * kSigma_m),
                                  normalize_angle(states[i].theta - truth.theta) / (kSigma_rad * kSigma_rad));
    }
  };
  return z;
}

ParticleSet<Pose2> cloud(std::size_t n, const Pose2& mean, double sigma_m, double sigma_rad,
                         std::uint64_t step) {
  const RandomStream random(5, RandomPurpose::kTest, step);
  ParticleSet<Pose2> particles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto g = random.normal4(i);
    particles.states.push_back(
        {mean.x + sigma_m * g[0], mean.y + sigma_m * g[1], normalize_angle(mean.theta + sigma_rad * g[2])});
  }
  particles.log_weights.assign(n, -std::log(static_cast<double>(n)));
  return particles;
}

double mean_distance(const ParticleSet<Pose2>& particles, const Pose2& truth) {
  double sum = 0.0;
  for (const Pose2& p : particles.states) sum += std::hypot(p.x - truth.x, p.y - truth.y);
  return sum / static_cast<double>(particles.size());
}

const Pose2 kTruth{1.0, -2.0, kPi - 0.01};
const RandomStream kRandom(1, RandomPurpose::kRefine, 1);

TEST(GradientRefinement, DrawsParticlesToTheMeasurement) {
  auto particles = cloud(20, {1.1, -2.1, kPi - 0.03}, 0.08, 0.03, 1);
  const double before = mean_distance(particles, kTruth);
  GradientRefinement({}).refine(measurement_of(kTruth), particles, kRandom, Executor());
  EXPECT_LT(mean_distance(particles, kTruth), 0.5 * before);
  for (const Pose2& p : particles.states) EXPECT_TRUE(p.theta >= -kPi && p.theta < kPi);
}

TEST(GradientRefinement, StepsAreBounded) {
  GradientRefinementOptions options;
  options.steps = 1;
  auto particles = cloud(50, {11.0, -2.0, 0.5}, 0.5, 0.5, 2);
  const auto before = particles.states;
  GradientRefinement(options).refine(measurement_of(kTruth), particles, kRandom, Executor());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Pose2& a = before[i];
    const Pose2& b = particles.states[i];
    EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), options.max_step_m + 1e-12);
    EXPECT_LE(std::abs(normalize_angle(b.theta - a.theta)), options.max_step_rad + 1e-12);
  }
}

// A gradient that leads downhill: the acceptance test keeps the predicted particles.
TEST(GradientRefinement, AcceptsWithTheRatioOfTheLikelihoods) {
  auto particles = cloud(400, {1.2, -2.0, kPi - 0.01}, 0.02, 0.01, 3);
  const auto before = particles.states;
  BoundUpdate<Pose2> z = measurement_of(kTruth, -1.0);
  GradientRefinementOptions options;
  options.steps = 1;
  options.max_step_m = 0.01, options.max_step_rad = 0.0;
  GradientRefinement(options).refine(z, particles, kRandom, Executor());
  int taken = 0;
  double expected = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    taken += particles.states[i] == before[i] ? 0 : 1;
    const double r = std::hypot(before[i].x - kTruth.x, before[i].y - kTruth.y);
    const double p = std::exp(-((r + 0.01) * (r + 0.01) - r * r) / (2 * kSigma_m * kSigma_m));
    expected += p;
    variance += p * (1 - p);
  }
  EXPECT_NEAR(taken, expected, 4.9 * std::sqrt(variance));  // alpha 1e-6
  EXPECT_LT(expected, 300.0);
}

TEST(GradientRefinement, WithoutGradientNothingChanges) {
  BoundUpdate<Pose2> z = measurement_of(kTruth);
  z.gradient = [](std::span<const Pose2>, std::span<Eigen::Vector3d> out) {
    std::fill(out.begin(), out.end(), Eigen::Vector3d::Zero());
  };
  auto particles = cloud(30, kTruth, 0.1, 0.1, 4);
  const auto before = particles;
  GradientRefinement({}).refine(z, particles, kRandom, Executor());
  EXPECT_EQ(particles.states, before.states);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(particles.log_weights[i], before.log_weights[i], 1e-12);
}

// The importance densities: refined and weighed particles stand for the posterior of Bayes' rule. Weighed by
// the likelihood alone, their spread would be 3.1 cm.
TEST(GradientRefinement, ThePosteriorIsThatOfBayes) {
  constexpr double kPrior_m = 0.05;
  const Pose2 prior{1.1, -2.0, kPi - 0.01};
  const double posterior = kSigma_m * kPrior_m / std::hypot(kSigma_m, kPrior_m);
  GradientRefinementOptions options;
  options.steps = 1;
  options.eta_position = options.eta_heading = 0.2;
  double mean = 0.0, spread = 0.0;
  constexpr int kRuns = 20;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    auto particles = cloud(200, prior, kPrior_m, 0.02, 10 + run);
    const BoundUpdate<Pose2> z = measurement_of(kTruth);
    GradientRefinement(options).refine(z, particles, RandomStream(run, RandomPurpose::kRefine, 1),
                                       Executor());
    std::vector<double> log_likelihood(particles.size()), weights;
    z.log_likelihood(particles.states, log_likelihood);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.log_weights[i] += log_likelihood[i];
    normalize_log_weights(particles.log_weights);
    for (const double w : particles.log_weights) weights.push_back(std::exp(w));
    const PoseMoments moments = weighted_moments(particles.states, weights);
    mean += moments.mean.x / kRuns;
    spread += std::sqrt(moments.covariance(1, 1)) / kRuns;
  }
  EXPECT_NEAR(mean, 1.05, 0.01);
  EXPECT_NEAR(spread, posterior, 0.0025);  // 3.54 cm
}

TEST(GradientRefinement, TheSameBytesForAnyNumberOfThreads) {
  auto one = cloud(100, kTruth, 0.1, 0.05, 7), many = one;
  GradientRefinement({}).refine(measurement_of(kTruth), one, kRandom, Executor(1));
  GradientRefinement({}).refine(measurement_of(kTruth), many, kRandom, Executor(4));
  EXPECT_EQ(one.states, many.states);
  EXPECT_EQ(one.log_weights, many.log_weights);
}

TEST(KernelDensity, IsThatOfAGaussianCloud) {
  const auto particles = cloud(2000, {0, 0, kPi}, 0.1, 0.05, 8);
  const KernelDensity density(particles.states, particles.log_weights);
  const auto log_density = density.log_density(
      std::vector<Pose2>{{0, 0, -kPi}, {0.1, 0, kPi}, {0, 0.1, kPi}, {0, 0, -kPi + 0.05}});
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(log_density[i] - log_density[0], -0.5, 0.12);
}

TEST(KernelDensity, IsFiniteFarAwayAndForOnePoint) {
  const std::vector<Pose2> poses(3, Pose2{1, 2, 3});
  const KernelDensity density(poses, std::vector<double>(3, -std::log(3.0)));
  const auto log_density = density.log_density(std::vector<Pose2>{{1, 2, 3}, {1e6, 2, 3}});
  EXPECT_NEAR(log_density[0], 0.0, 1e-12);
  EXPECT_NEAR(log_density[1], -722.0, 1e-9);
}

}  // namespace
}  // namespace cairn
