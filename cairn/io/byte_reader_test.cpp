#include "cairn/io/byte_reader.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using namespace std::string_literals;

TEST(ByteReader, ReadsLittleEndianNumbersAndBlocks) {
  const std::string bytes = "\x01\x02\x00\x00\x03\x00\x00\x00"s + "abc" + "\x00\x00\x80\x3f"s;
  ByteReader reader(bytes);
  EXPECT_EQ(reader.number<std::uint32_t>(), 513u);
  EXPECT_EQ(reader.block(), "abc");
  EXPECT_EQ(reader.position(), 11u);
  EXPECT_EQ(reader.number<float>(), 1.0f);
  EXPECT_TRUE(reader.at_end());
  EXPECT_TRUE(reader.ok());
}

TEST(ByteReader, ReadingPastTheEndGivesZerosAndIsRemembered) {
  const std::string bytes = "\xff\xff\xff";
  ByteReader reader(bytes);
  EXPECT_EQ(reader.number<std::uint32_t>(), 0u);
  EXPECT_FALSE(reader.ok());
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(reader.take(0), "");
  EXPECT_EQ(reader.number<std::uint8_t>(), 0u);
  EXPECT_FALSE(reader.ok());
}

TEST(ByteReader, ABlockLongerThanTheRestIsNotTaken) {
  const std::string bytes =
      "\xff\xff\xff\xff"
      "abc"s;
  ByteReader reader(bytes);
  EXPECT_EQ(reader.block(), "");
  EXPECT_FALSE(reader.ok());
}

TEST(ByteReader, NothingHoldsAnEmptyBlockOnly) {
  ByteReader reader("");
  EXPECT_EQ(reader.take(0), "");
  EXPECT_TRUE(reader.ok());
  EXPECT_TRUE(reader.at_end());
}

}  // namespace
}  // namespace cairn
