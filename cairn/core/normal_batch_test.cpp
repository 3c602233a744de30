#include "cairn/core/normal_batch.hpp"

#include "simd_paths.hpp"

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
  const auto batch = std::make_unique<NormalBatch>();
  for (std::uint32_t first = 0; first < items; first += static_cast<std::uint32_t>(per_batch)) {
    const std::size_t count = std::min<std::size_t>(per_batch, items - first);
    batch->fill(random, first, count);
    for (std::size_t i = 0; i < count; ++i) {
      for (const auto& row : batch->number) all.push_back(row[i]);
    }
  }
  return all;
}

TEST(NormalBatch, EqualsTheStreamInSinglePrecision) {
  const RandomStream random = RandomStream(0x1122334455667788u, RandomPurpose::kTest, 0x99aabbccddeeff00u);
  test::on_every_simd_path([&](SimdPath path) {
    const std::vector<float> found = numbers(random, 20'000, 128);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      const auto expected = random.normal4(i);
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_NEAR(found[4 * i + k], expected[k], 2e-6 * (1.0 + std::abs(expected[k])))
            << name_of(path) << ", item " << i;
      }
    }
  });
}

TEST(NormalBatch, EveryPathAndEveryBatchGivesTheSameBits) {
  const RandomStream random =
      RandomStream(7, RandomPurpose::kMotion, 3).from_item(0xffffff00u);  // wraps around
  const std::vector<float> expected = numbers(random, 1000, 128);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t per_batch : {1, 7, 16, 100, 128})
      EXPECT_EQ(numbers(random, 1000, per_batch), expected) << name_of(path) << ", batches of " << per_batch;
  });
}

TEST(NormalBatch, DrawsAreOthers) {
  const RandomStream random(7, RandomPurpose::kMotion, 3);
  NormalBatch a, b;
  a.fill(random, 5, 1, 2);
  b.fill(random, 5, 1, 3);
  EXPECT_NE(a.number[0][0], b.number[0][0]);
  EXPECT_NEAR(a.number[0][0], random.normal4(5, 2)[0], 1e-5);
}

// Moments 1 to 4 of 4 million numbers: within 1e-3 of 0, 1, 0, 3 as far as chance allows (their standard
// errors are 0.5e-3, 0.7e-3, 1.9e-3 and 4.9e-3), and as many beyond z as erfc says (binomial).
TEST(NormalBatch, MomentsAndTails) {
  constexpr std::uint32_t kItems = 1'000'000;
  const RandomStream random(3, RandomPurpose::kTest, 5);
  const double n = 4.0 * kItems;
  std::array<double, 4> sum{};
  std::array<double, 5> above{}, below{};
  for (const float x : numbers(random, kItems, 128)) {
    double power = 1.0;
    for (double& s : sum) s += power *= x;
    for (std::size_t z = 1; z < above.size(); ++z) above[z] += x > static_cast<float>(z);
    for (std::size_t z = 1; z < below.size(); ++z) below[z] += x < -static_cast<float>(z);
  }
  EXPECT_NEAR(sum[0] / n, 0.0, std::max(1e-3, kAlarm * std::sqrt(1.0 / n)));
  EXPECT_NEAR(sum[1] / n, 1.0, std::max(1e-3, kAlarm * std::sqrt(2.0 / n)));
  EXPECT_NEAR(sum[2] / n, 0.0, std::max(1e-3, kAlarm * std::sqrt(15.0 / n)));
  EXPECT_NEAR(sum[3] / n, 3.0, std::max(1e-3, kAlarm * std::sqrt(96.0 / n)));
  for (std::size_t z = 1; z < above.size(); ++z) {
    const double p = 0.5 * std::erfc(static_cast<double>(z) / std::sqrt(2.0));
    const double bound = kAlarm * std::sqrt(n * p * (1.0 - p)) + 1.0;
    EXPECT_NEAR(above[z], n * p, bound) << z;
    EXPECT_NEAR(below[z], n * p, bound) << z;
  }
}

}  // namespace
}  // namespace cairn
