#include "cairn/io/cdr.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::cdr {
namespace {

using namespace std::string_literals;

// The bytes stand in the DDS-XTypes specification's own way: header, then aligned from byte 4.
TEST(Cdr, LittleEndianBytesAreTheOnesOfTheSpecification) {
  Writer writer;
  writer.number(std::uint8_t{7}).number(std::int32_t{-2}).text("ab").number(1.0);
  EXPECT_EQ(writer.bytes(),
            "\0\1\0\0"
            "\7\0\0\0"
            "\xfe\xff\xff\xff"
            "\3\0\0\0ab\0\0"
            "\0\0\0\0\0\0\xf0\x3f"s);
}

TEST(Cdr, BigEndianBytesAreTheOnesOfTheSpecification) {
  Writer writer(ByteOrder::kBig);
  writer.number(std::uint8_t{7}).number(std::int32_t{-2}).text("ab").number(1.0);
  EXPECT_EQ(writer.bytes(),
            "\0\0\0\0"
            "\7\0\0\0"
            "\xff\xff\xff\xfe"
            "\0\0\0\3ab\0\0"
            "\x3f\xf0\0\0\0\0\0\0"s);
}

class CdrByteOrder : public testing::TestWithParam<ByteOrder> {};
INSTANTIATE_TEST_SUITE_P(Orders, CdrByteOrder, testing::Values(ByteOrder::kLittle, ByteOrder::kBig));

TEST_P(CdrByteOrder, ReadsWhatWasWritten) {
  const std::vector<float> floats{1.5F, -0.0F, std::numeric_limits<float>::infinity()};
  const std::vector<double> doubles{0.1, -1e300};
  Writer writer(GetParam());
  writer.number(std::uint8_t{1}).numbers(std::span<const float>(floats)).text("").number(std::uint16_t{513});
  writer.numbers(std::span<const double>(doubles)).number(std::int64_t{-5});
  Reader reader(writer.bytes());
  EXPECT_EQ(reader.number<std::uint8_t>(), 1);
  EXPECT_EQ(reader.numbers<float>(), floats);
  EXPECT_EQ(reader.text(), "");
  EXPECT_EQ(reader.number<std::uint16_t>(), 513);
  EXPECT_EQ(reader.numbers<double>(), doubles);
  EXPECT_EQ(reader.number<std::int64_t>(), -5);
  EXPECT_TRUE(reader.ok());
}

TEST_P(CdrByteOrder, ANaNKeepsItsBits) {
  const auto nan = std::bit_cast<float>(0x7fc12345U);
  const std::vector<float> values{nan};
  Writer writer(GetParam());
  writer.numbers(std::span<const float>(values));
  Reader reader(writer.bytes());
  EXPECT_EQ(std::bit_cast<std::uint32_t>(reader.numbers<float>().at(0)), 0x7fc12345U);
}

TEST_P(CdrByteOrder, EveryCutReadsAsZerosAndIsNotOk) {
  Writer writer(GetParam());
  writer.number(3.0).text("name").number(std::uint32_t{9});
  for (std::size_t size = kHeaderBytes; size < writer.bytes().size(); ++size) {
    Reader reader(std::string_view(writer.bytes()).substr(0, size));
    reader.number<double>();
    reader.text();
    EXPECT_EQ(reader.number<std::uint32_t>(), 0U);
    EXPECT_FALSE(reader.ok()) << size;
  }
}

TEST(Cdr, AnnouncedLengthsAreNotBelieved) {
  for (const std::uint32_t announced : {3U, 1'000'000'000U, 0x40000000U, 0xffffffffU}) {
    const std::string bytes = Writer().number(announced).number(0U).number(0U).bytes();
    EXPECT_THROW(Reader(bytes).numbers<float>(), ros::MalformedMessage) << announced;
    Reader reader(bytes);
    EXPECT_TRUE(announced == 3U || reader.text().empty());
  }
}

TEST(Cdr, WhatIsNoPlainCdrIsRefused) {
  for (const std::string& header : {""s, "\0"s, "\0\1\0"s, "\1\0\0\0"s, "\0\2\0\0"s, "\0\7\0\0"s, "text"s}) {
    EXPECT_THROW(Reader reader(header), ros::MalformedMessage);
  }
  EXPECT_NO_THROW(Reader reader("\0\1\0\0"s));
}

}  // namespace
}  // namespace cairn::cdr
