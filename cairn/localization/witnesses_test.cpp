#include "cairn/localization/witnesses.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Witnesses, OneVouchesForTheOthersNotForItself) {
  Witnesses witnesses(3);
  EXPECT_FALSE(witnesses.vouched(0));
  witnesses.hear(0, 1.0, 0.9);
  EXPECT_FALSE(witnesses.vouched(0));
  EXPECT_TRUE(witnesses.vouched(1));
  EXPECT_TRUE(witnesses.vouched(2));
  witnesses.hear(0, -1.0, 0.9);
  EXPECT_FALSE(witnesses.vouched(1));
}

// Nothing speaks against the pose, but people hide nearly all.
TEST(Witnesses, OneAmongPeopleVouchesForNothing) {
  Witnesses witnesses(2);
  witnesses.hear(0, 0.6, 0.4);
  EXPECT_FALSE(witnesses.vouched(1));
  witnesses.hear(0, 0.6, Witnesses::kExpected);
  EXPECT_TRUE(witnesses.vouched(1));
}

TEST(Witnesses, OneThatFallsSilentIsForgotten) {
  Witnesses witnesses(2);
  EXPECT_TRUE(witnesses.alone(1));
  witnesses.hear(0, 1.0, 0.9);
  for (int i = 0; i < Witnesses::kStillHeard; ++i) witnesses.pass();
  EXPECT_TRUE(witnesses.vouched(1));
  EXPECT_FALSE(witnesses.alone(1));
  EXPECT_TRUE(witnesses.alone(0));
  witnesses.pass();
  EXPECT_FALSE(witnesses.vouched(1));
  EXPECT_TRUE(witnesses.alone(1));
}

}  // namespace
}  // namespace cairn
