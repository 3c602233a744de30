#include "cairn/core/large_vector.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(LargeVector, BeginsOnALargePageWhereItIsLarge) {
  const LargeVector<std::uint16_t> large(kLargeBytes / 2 + 1);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % (2u << 20), 0u);
}

TEST(LargeVector, HoldsItsValuesWhenItGrowsFromSmallToLarge) {
  LargeVector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < kLargeBytes; i += 2) numbers.push_back(i);
  for (std::uint32_t i = 0; i < kLargeBytes; i += 2) ASSERT_EQ(numbers[i / 2], i);
}

TEST(LargeVector, IsFilledWithTheValueThatIsAskedFor) {
  const LargeVector<std::uint8_t> sevens(kLargeBytes, 7);
  for (const std::uint8_t seven : sevens) ASSERT_EQ(seven, 7);
}

TEST(LargeVector, ASizeBeyondAllMemoryIsRefused) {
  LargeAllocator<double> allocator;
  EXPECT_THROW(allocator.allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

}  // namespace
}  // namespace cairn
