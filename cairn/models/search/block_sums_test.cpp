#include "cairn/models/search/block_sums.hpp"

#include "cairn/core/rng.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Against plain sums, over more blocks than a lane of 16 bits holds of the largest byte.
TEST(BlockSums, AreThoseOfEachPlace) {
  constexpr std::size_t kStep = 23;
  std::vector<std::uint8_t> bytes(4000);
  const RandomStream random(1, RandomPurpose::kTest, 0);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] =
        i % 5 == 0 ? 255 : static_cast<std::uint8_t>(256.0 * random.uniform(static_cast<std::uint32_t>(i)));
  BlockSums sums;
  BlockSums::Sums expected{};
  for (std::size_t at = 0; at < 900; ++at) {
    const std::size_t place = at % 4 == 0 ? 0 : 4 * at;
    sums.add(bytes.data() + place, kStep);
    for (std::size_t i = 0; i < 16; ++i) expected[i] += bytes[place + i / 4 * kStep + i % 4];
    if (at == 100) {
      EXPECT_EQ(sums.sums(), expected);
    }
  }
  EXPECT_GT(expected[0], 0xFFFFu);
  EXPECT_EQ(sums.sums(), expected);
}

TEST(BlockSums, TheLargestBytesNeverRunOver) {
  const std::vector<std::uint8_t> bytes(16, 255);
  BlockSums sums;
  for (int i = 0; i < 1000; ++i) sums.add(bytes.data(), 4);
  for (const std::uint32_t sum : sums.sums()) EXPECT_EQ(sum, 255'000u);
}

}  // namespace
}  // namespace cairn
