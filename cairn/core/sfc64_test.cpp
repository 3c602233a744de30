#include "cairn/core/sfc64.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// What PractRand's own implementation gives, which runs through 18 numbers first; published with the tests of
// Apache Commons RNG.
TEST(Sfc64, KnownAnswers) {
  Sfc64 random{0x012de1babb3c4104u, 0xc8161b4202294965u, 0xb5ad4eceda1ce2a9u};
  for (int i = 0; i < 18; ++i) random.next();
  for (const std::uint64_t expected : {0x383be11f844db7f4u, 0x563e7e24056ad886u, 0x959e56afde1c3f72u,
                                       0x7924b83a8ac40b01u, 0xe3096acc85876ae6u, 0x9932c32968faf17eu})
    EXPECT_EQ(random.next(), expected);
}

}  // namespace
}  // namespace cairn
