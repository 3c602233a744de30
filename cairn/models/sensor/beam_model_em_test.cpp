#include "cairn/models/sensor/beam_model_em.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kReach = 12.0;

// A reading of a wall at `expected_m`, drawn from the mixture; short ones by rejection.
double draw_reading(const BeamModelOptions& o, double expected_m, const RandomStream& random,
                    std::uint32_t i) {
  const auto u = random.uniform4(2 * i);
  const auto n = random.normal4(2 * i + 1);
  if (u[0] < o.z_hit) return std::min(expected_m + o.sigma_hit_m * n[0], kReach);
  if (u[0] < o.z_hit + o.z_short) {
    const double cut = -std::expm1(-o.lambda_short_per_m * expected_m);
    return -std::log1p(-u[1] * cut) / o.lambda_short_per_m;
  }
  return u[0] < o.z_hit + o.z_short + o.z_max ? kReach : u[1] * kReach;
}

std::vector<BeamSample> samples_of(const BeamModelOptions& truth, std::uint32_t count) {
  const RandomStream random(11, RandomPurpose::kTest, 0);
  std::vector<BeamSample> samples;
  for (std::uint32_t i = 0; i < count; ++i) {
    // Walls from 0.5 m to 13 m: some beyond reach, some just at it.
    const double expected = 0.5 + 12.5 * random.uniform(1'000'000 + i);
    const double z = draw_reading(truth, expected, random, i);
    if (z > 0.0) samples.push_back({z, expected});
  }
  return samples;
}

BeamModelOptions truth() {
  BeamModelOptions o;
  o.z_hit = 0.6, o.z_short = 0.2, o.z_max = 0.08, o.z_rand = 0.12;
  o.sigma_hit_m = 0.17, o.lambda_short_per_m = 0.45;
  return o;
}

TEST(BeamModelEm, FindsTheParametersThatMadeTheReadings) {
  const auto samples = samples_of(truth(), 20'000);
  const BeamEmResult result = learn_beam_model(samples, kReach, {});
  EXPECT_TRUE(result.converged);
  const BeamModelOptions& o = result.options();
  // About five standard errors of 20,000 readings.
  EXPECT_NEAR(o.z_hit, 0.6, 0.02);
  EXPECT_NEAR(o.z_short, 0.2, 0.025);
  EXPECT_NEAR(o.z_max, 0.08, 0.01);
  EXPECT_NEAR(o.z_rand, 0.12, 0.025);
  EXPECT_NEAR(o.sigma_hit_m, 0.17, 0.006);
  EXPECT_NEAR(o.lambda_short_per_m, 0.45, 0.08);
}

TEST(BeamModelEm, NoIterationLowersTheLikelihood) {
  const BeamEmResult result = learn_beam_model(samples_of(truth(), 2000), kReach, {});
  ASSERT_GT(result.steps.size(), 5U);
  for (std::size_t i = 1; i < result.steps.size(); ++i) {
    EXPECT_GE(result.steps[i].mean_log_likelihood, result.steps[i - 1].mean_log_likelihood - 1e-12) << i;
  }
}

TEST(BeamModelEm, ReportsTheLikelihoodOfItsParameters) {
  const auto samples = samples_of(truth(), 500);
  const BeamEmResult result = learn_beam_model(samples, kReach, {});
  EXPECT_NEAR(result.steps.back().mean_log_likelihood, mean_log_likelihood(samples, kReach, result.options()),
              1e-9);
  EXPECT_GT(result.steps.back().mean_log_likelihood, mean_log_likelihood(samples, kReach, {}));
}

TEST(BeamModelEm, ReadingsWithoutReturnAloneLeaveTheRestInRange) {
  const std::vector<BeamSample> samples(10, {kReach, 1e9});
  const BeamModelOptions o = learn_beam_model(samples, kReach, {}).options();
  EXPECT_TRUE(std::isfinite(o.sigma_hit_m) && std::isfinite(o.lambda_short_per_m));
  EXPECT_GT(o.z_max + o.z_hit, 0.99);
}

TEST(BeamModelEm, RefusesWhatIsNoReading) {
  const double nan = std::nan("");
  EXPECT_THROW(learn_beam_model({}, kReach, {}), InputError);
  for (const BeamSample& bad : {BeamSample{nan, 1.0}, {1.0, nan}, {-1.0, 1.0}, {1.0, -1.0}}) {
    EXPECT_THROW(learn_beam_model(std::vector{bad}, kReach, {}), InputError);
  }
}

}  // namespace
}  // namespace cairn
