#include "cairn/eval/base64.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// RFC 4648, section 10.
TEST(Base64, AgreesWithTheVectorsOfTheStandard) {
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(to_base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAnyByte) { EXPECT_EQ(to_base64(std::string("\x00\xff\xfe\x80", 4)), "AP/+gA=="); }

}  // namespace
}  // namespace cairn
