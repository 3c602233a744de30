#include "cairn/core/normal3_batch.hpp"

#include "simd_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two-sided bound of a standard normal number with false-alarm probability 1e-6.
constexpr double kAlarm = 4.892;

// The numbers of items [0, items), one batch after the other, item by item.
std::vector<float> numbers(const RandomStream& random, std::uint32_t items, std::size_t per_batch) {
  std::vector<float> all;
  const auto batch = std::make_unique<Normal3Batch>();
  for (std::uint32_t first = 0; first < items; first += static_cast<std::uint32_t>(per_batch)) {
    const std::size_t count = std::min<std::size_t>(per_batch, items - first);
    batch->fill(random, first, count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        all.push_back(static_cast<float>(batch->number(k)[i] * Normal3::kUnit));
    }
  }
  return all;
}

TEST(Normal3Batch, EqualsTheStream) {
  const RandomStream random(0x1122334455667788u, RandomPurpose::kTest, 0x99aabbccddeeff00u);
  test::on_every_simd_path([&](SimdPath path) {
    Normal3Batch batch;
    for (std::uint32_t first = 0; first < 20'000; first += 125) {
      batch.fill(random, first, 125);
      for (std::uint32_t i = 0; i < 125; ++i) {
        const auto expected = random.normal3(first + i);
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(batch.number(k)[i] * Normal3::kUnit, expected[k])
              << name_of(path) << ", item " << first + i;
      }
    }
  });
}

TEST(Normal3Batch, EveryPathAndEveryBatchGivesTheSameBits) {
  const RandomStream random = RandomStream(7, RandomPurpose::kMotion, 3).from_item(1'000'005);
  const std::vector<float> expected = numbers(random, 1000, 128);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t per_batch : {1, 7, 16, 31, 100, 128, 512})
      EXPECT_EQ(numbers(random, 1000, per_batch), expected) << name_of(path) << ", batches of " << per_batch;
  });
}

TEST(Normal3Batch, DrawsAreOthers) {
  const RandomStream random(7, RandomPurpose::kMotion, 3);
  Normal3Batch a, b;
  a.fill(random, 5, 1, 2);
  b.fill(random, 5, 1, 4);
  EXPECT_NE(a.number(0)[0], b.number(0)[0]);
  EXPECT_EQ(a.number(2)[0] * Normal3::kUnit, random.normal3(5, 2)[2]);
}

// The words of every lane of the last vectors, and the extreme ones.
TEST(Normal3Batch, TheNumbersEndAtFourPointEightFour) {
  double largest = 0.0;
  for (const float x : numbers({5, RandomPurpose::kTest, 1}, 2'000'000, 128)) {
    ASSERT_TRUE(std::isfinite(x));
    largest = std::max<double>(largest, std::abs(x));
  }
  EXPECT_LT(largest, 4.842);
  EXPECT_GT(largest, 4.79);  // the last 16 numbers of each sign: missed by six million with probability 1e-5
}

// Moments 1 to 4 of 3 million numbers, of each of the three and of their products: within 1e-3 of those of
// independent normal numbers as far as chance allows; as many beyond z as erfc says (binomial).
TEST(Normal3Batch, MomentsAndTails) {
  constexpr std::uint32_t kItems = 1'000'000;
  const std::vector<float> all = numbers({3, RandomPurpose::kTest, 5}, kItems, 128);
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 4> sum{};
    std::array<double, 5> above{}, below{};
    double product = 0.0, of_squares = 0.0, of_neighbours = 0.0;
    for (std::size_t i = 0; i < kItems; ++i) {
      const double x = all[3 * i + k], y = all[3 * i + (k + 1) % 3], next = all[3 * ((i + 16) % kItems) + k];
      double power = 1.0;
      for (double& s : sum) s += power *= x;
      product += x * y, of_squares += (x * x - 1.0) * (y * y - 1.0), of_neighbours += x * next;
      for (std::size_t z = 1; z < above.size(); ++z) above[z] += x > static_cast<double>(z);
      for (std::size_t z = 1; z < below.size(); ++z) below[z] += x < -static_cast<double>(z);
    }
    const auto expect_mean = [&](double total, double mean, double variance) {
      EXPECT_NEAR(total / kItems, mean, std::max(1e-3, kAlarm * std::sqrt(variance / kItems))) << k;
    };
    expect_mean(sum[0], 0.0, 1.0);
    expect_mean(sum[1], 1.0, 2.0);
    expect_mean(sum[2], 0.0, 15.0);
    expect_mean(sum[3], 3.0, 96.0);
    expect_mean(product, 0.0, 1.0);
    expect_mean(of_squares, 0.0, 4.0);
    expect_mean(of_neighbours, 0.0, 1.0);
    for (std::size_t z = 1; z < above.size(); ++z) {
      const double p = 0.5 * std::erfc(static_cast<double>(z) / std::sqrt(2.0));
      const double bound = kAlarm * std::sqrt(kItems * p * (1.0 - p)) + 1.0;
      EXPECT_NEAR(above[z], kItems * p, bound) << k << ' ' << z;
      EXPECT_NEAR(below[z], kItems * p, bound) << k << ' ' << z;
    }
  }
}

}  // namespace
}  // namespace cairn
