#include "apps/cairn/seed_option.hpp"

#include "cairn/core/errors.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

TEST(ParseSeed, TakesAllOf64Bits) {
  EXPECT_EQ(parse_seed("--seed", "0"), 0U);
  EXPECT_EQ(parse_seed("--seed", "18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parse_seed("--seed", "010"), 10U) << "decimal, whatever it begins with";
}

TEST(ParseSeed, RefusesTheRest) {
  for (const char* text : {"", "-1", "+1", "1.5", "0x10", " 1", "1 ", "18446744073709551616", "one"}) {
    EXPECT_THROW(parse_seed("--seed", text), ConfigurationError) << text;
  }
}

}  // namespace
}  // namespace cairn::app
