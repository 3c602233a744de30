#include "cairn/core/batch_math.hpp"

#include "simd_paths.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> exponents() {
  std::vector<double> values;
  for (int i = 0; i < 5003; ++i) values.push_back(-708.0 + 0.2832 * i);
  for (const double tiny : {0.0, -0.0, 1e-300, -1e-17, 0.34657359027997264, -0.34657359027997264})
    values.push_back(tiny);
  return values;
}

TEST(ExpAll, EqualsTheLibraryOnEveryPath) {
  const std::vector<double> values = exponents();
  std::vector<double> first;
  test::on_every_simd_path([&](SimdPath path) {
    std::vector<double> out(values.size());
    exp_all(values, 0.0, out);
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_NEAR(out[i] / std::exp(values[i]), 1.0, 5e-16) << values[i] << ' ' << name_of(path);
    if (first.empty()) first = out;
    EXPECT_EQ(out, first) << name_of(path);
  });
}

TEST(ExpAll, BeyondItsRange) {
  std::vector<double> values = {-708.1, -1e308, -kInfinity, 1e3, kInfinity, 0.0};
  exp_all(values, 0.0, values);  // in place
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(values[i], 0.0);
  for (std::size_t i = 3; i < 5; ++i) EXPECT_NEAR(values[i] / std::exp(709.0), 1.0, 1e-15);
  EXPECT_EQ(values[5], 1.0);
}

TEST(ExpAll, ABatchIsOneByOne) {
  const std::vector<double> values = exponents();
  std::vector<double> out(values.size());
  exp_all(values, -3.0, out);
  for (std::size_t i = 0; i < values.size(); ++i) {
    double alone = 0.0;
    exp_all(std::span(values).subspan(i, 1), -3.0, std::span(&alone, 1));
    ASSERT_EQ(alone, out[i]);
  }
  exp_all({}, 0.0, {});
}

TEST(SineCosineAll, EqualTheLibraryOnEveryPath) {
  std::vector<double> angles;
  for (int i = -3001; i < 3001; ++i) angles.push_back(0.0031 * i);
  for (const double far : {1e5, -99999.9, 5e5, 1e-300, 0.0}) angles.push_back(far);
  std::vector<double> first;
  test::on_every_simd_path([&](SimdPath path) {
    std::vector<double> sine(angles.size()), cosine(angles.size());
    sine_cosine_all(angles, sine, cosine);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      ASSERT_NEAR(sine[i], std::sin(angles[i]), 2.3e-16) << angles[i];
      ASSERT_NEAR(cosine[i], std::cos(angles[i]), 2.3e-16) << angles[i];
    }
    if (first.empty()) first = sine;
    EXPECT_EQ(sine, first) << name_of(path);
  });
}

TEST(LargestOf, IsFoundWhereverItIsOnEveryPath) {
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t n : {1u, 2u, 7u, 16u, 33u, 65u}) {
      for (std::size_t at = 0; at < n; ++at) {
        std::vector<double> values(n, -1e300);
        values[at] = -3.0;
        EXPECT_EQ(largest_of(values), -3.0) << name_of(path) << ' ' << n << ' ' << at;
      }
    }
  });
}

TEST(SumOf, AddsAllOfThem) {
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<double> values(n);
    std::iota(values.begin(), values.end(), 1.0);
    const auto m = static_cast<double>(n);
    EXPECT_EQ(sum_of(values), m * (m + 1) / 2);
    EXPECT_EQ(sum_of_squares(values), m * (m + 1) * (2 * m + 1) / 6);
  }
}

}  // namespace
}  // namespace cairn
