#include "cairn/models/sensor/beam_mixture_kernels.hpp"

#include "cairn/models/sensor/beam_model.hpp"
#include "simd_paths.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kReach_m = 10.0, kMapReach_m = 12.0, kDepth_m = 0.025;

BeamCauses causes_of(const BeamModelOptions& o) {
  const double weights = o.z_hit + o.z_short + o.z_max + o.z_rand;
  return {.hit = static_cast<float>(o.z_hit / weights / (o.sigma_hit_m * std::sqrt(2.0 * std::acos(-1.0)))),
          .per_sigma = static_cast<float>(1.0 / o.sigma_hit_m),
          .lambda_per_m = static_cast<float>(o.lambda_short_per_m),
          .rand = static_cast<float>(o.z_rand / weights / kReach_m),
          .depth_m = static_cast<float>(kDepth_m),
          .max_range_m = static_cast<float>(kMapReach_m)};
}

// From a wall at the sensor to beyond the map's reach.
std::vector<float> some_ranges() {
  std::vector<float> ranges;
  for (std::size_t i = 0; i < BeamProducts::kCapacity; ++i)
    ranges.push_back(
        static_cast<float>(kMapReach_m * static_cast<double>(i) / (BeamProducts::kCapacity - 1)));
  return ranges;
}

BeamProducts products_of(const BeamModelOptions& o, const std::vector<double>& readings_m) {
  const double weights = o.z_hit + o.z_short + o.z_max + o.z_rand;
  BeamProducts products;
  products.begin();
  for (const double z : readings_m) {
    const double decay = o.lambda_short_per_m * std::exp(-o.lambda_short_per_m * z);
    multiply_return(causes_of(o), static_cast<float>(z), static_cast<float>(o.z_short / weights * decay),
                    some_ranges().data(), products);
  }
  return products;
}

// Readings before, at and behind walls. Densities of less than 1e-15 count as that, here and there.
TEST(MultiplyReturn, IsTheMixture) {
  for (const double sigma : {0.02, 0.1, 0.5}) {
    BeamModelOptions o;
    o.sigma_hit_m = sigma;
    const BeamMixture mixture(o, kReach_m);
    for (const double z : {0.1, 2.0, 5.03, 9.99}) {
      const BeamProducts products = products_of(o, {z});
      for (std::size_t i = 0; i < BeamProducts::kCapacity; ++i) {
        const double r = some_ranges()[i] + kDepth_m;
        EXPECT_NEAR(products.log(i), mixture.log_likelihood(z, r < kMapReach_m ? r : 1e9), 2e-4)
            << sigma << ' ' << z << ' ' << r;
      }
    }
  }
}

TEST(MultiplyReturn, ThousandsOfBeamsDoNotUnderflow) {
  BeamModelOptions o;
  o.z_rand = 1e-6;
  const BeamProducts one = products_of(o, {9.5}), many = products_of(o, std::vector<double>(3000, 9.5));
  for (std::size_t i = 0; i < BeamProducts::kCapacity; ++i)
    EXPECT_NEAR(many.log(i), 3000.0 * one.log(i), 1e-6 * std::abs(many.log(i)) + 0.01);
  EXPECT_LT(many.log(0), -1e4);
}

TEST(Multiply, IsTheProduct) {
  std::vector<float> probabilities(BeamProducts::kCapacity, 0.25f);
  probabilities[0] = 0.0f, probabilities[1] = 400.0f;
  BeamProducts products;
  products.begin();
  for (int k = 0; k < 100; ++k) multiply(probabilities.data(), products);
  EXPECT_NEAR(products.log(0), 100.0 * std::log(1e-15), 1e-3);
  EXPECT_NEAR(products.log(1), 100.0 * std::log(400.0), 1e-3);
  EXPECT_NEAR(products.log(2), 100.0 * std::log(0.25), 1e-9);
}

TEST(MultiplyReturn, EveryPathGivesTheSameBits) {
  const std::vector<double> readings = {0.3, 1.0, 4.2, 4.3, 8.8};
  const BeamProducts expected = products_of({}, readings);
  test::on_every_simd_path([&](SimdPath path) {
    const BeamProducts found = products_of({}, readings);
    EXPECT_EQ(std::memcmp(&found, &expected, sizeof found), 0) << name_of(path);
  });
}

}  // namespace
}  // namespace cairn
