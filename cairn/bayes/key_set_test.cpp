#include "cairn/bayes/key_set.hpp"

#include "cairn/core/rng.hpp"

#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(KeySet, CountsLikeAStandardSet) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  KeySet keys;
  for (std::uint32_t round = 0; round < 20; ++round) {
    keys.clear();
    EXPECT_EQ(keys.size(), 0u);
    std::set<std::uint64_t> expected;
    const std::uint32_t count = 1 + 300 * (round % 5);
    for (std::uint32_t i = 0; i < count; ++i) {
      // Many repetitions; keys that differ in their high bits only; zero among them.
      const auto u = random.uniform4(i, static_cast<std::uint16_t>(round));
      const auto key = static_cast<std::uint64_t>(u[0] * 200.0) << (u[1] < 0.5 ? 0 : 50);
      keys.insert(key);
      expected.insert(key);
      ASSERT_EQ(keys.size(), expected.size());
    }
  }
}

}  // namespace
}  // namespace cairn
