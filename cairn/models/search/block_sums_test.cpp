#include "cairn/models/search/block_sums.hpp"

#include "cairn/core/rng.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr std::size_t kStep = 92;  // bands of 23 columns

// Against plain sums, over more blocks than a lane of 16 bits holds of the largest byte.
TEST(BlockSums, AreThoseOfEachPlace) {
  std::vector<std::uint8_t> bytes(4000);
  const RandomStream random(1, RandomPurpose::kTest, 0);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] =
        static_cast<std::uint8_t>(i % 5 == 0 ? 255.0 : 256.0 * random.uniform(static_cast<std::uint32_t>(i)));
  BlockSums sums;
  BlockSums::Sums expected{};
  for (std::size_t n = 0; n < 900; ++n) {
    const BlockPlace place{bytes.data() + (n % 4 == 0 ? 0 : 4 * n), kStep, static_cast<unsigned>(n / 8 % 4)};
    sums.add(place);
    for (std::size_t i = 0; i < 16; ++i) expected[i] += place.at(i % 4, i / 4);
    if (n == 100) {
      EXPECT_EQ(sums.sums(), expected);
    }
  }
  EXPECT_GT(expected[0], 0xFFFFu);
  EXPECT_EQ(sums.sums(), expected);
}

TEST(BlockPlace, RowsGoOnInTheBandAbove) {
  std::vector<std::uint8_t> bytes(2 * kStep);
  bytes[23] = 7;          // column 5, row 3
  bytes[kStep + 25] = 9;  // column 6, row 5
  const BlockPlace place{bytes.data() + 20, kStep, 2};
  EXPECT_EQ(place.at(0, 1), 7);
  EXPECT_EQ(place.at(1, 3), 9);
}

TEST(BlockSums, TheLargestBytesNeverRunOver) {
  const std::vector<std::uint8_t> bytes(32, 255);
  BlockSums sums;
  for (int i = 0; i < 1000; ++i) sums.add({bytes.data(), 16, 1});
  for (const std::uint32_t sum : sums.sums()) EXPECT_EQ(sum, 255'000u);
}

}  // namespace
}  // namespace cairn
