#include "cairn/io/rosbag1_records.hpp"

#include "rosbag_writer.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace cairn::rosbag1 {
namespace {

using test::Bytes;
using Status = RecordStream::Status;

const std::string kHeader =
    Bytes().field("op", '\x05').field("size", 77u).field("topic", std::string_view("/a=b")).text();

TEST(Rosbag1Records, FindsHeaderFields) {
  EXPECT_EQ(header_op(kHeader), Op::kChunk);
  EXPECT_EQ(header_number<std::uint32_t>(kHeader, "size"), 77u);
  EXPECT_EQ(header_field(kHeader, "topic"), "/a=b");
  EXPECT_FALSE(header_field(kHeader, "siz").has_value());
  EXPECT_FALSE(header_field("", "op").has_value());
}

TEST(Rosbag1Records, ANumberOfAnotherWidthIsNone) {
  EXPECT_FALSE(header_number<std::uint64_t>(kHeader, "size").has_value());
  EXPECT_FALSE(header_number<std::uint8_t>(kHeader, "topic").has_value());
}

TEST(Rosbag1Records, DamagedHeadersHaveNoFieldsBeyondTheDamage) {
  for (std::size_t size = 0; size < kHeader.size(); ++size) {
    EXPECT_FALSE(header_field(kHeader.substr(0, size), "topic").has_value()) << size;
  }
  EXPECT_FALSE(header_field(Bytes().block("no equals sign").raw(kHeader).text(), "op").has_value());
  EXPECT_FALSE(header_field(std::string(8, '\xff'), "op").has_value());
}

TEST(Rosbag1Records, StreamTellsRecordsEndsAndCuts) {
  const std::string bag = Bytes().block(kHeader).block("data").text();
  for (std::size_t size = 0; size <= bag.size(); ++size) {
    std::istringstream input(bag.substr(0, size));
    RecordStream stream(input);
    const Status expected = size == 0           ? Status::kEnd
                            : size < bag.size() ? Status::kCutShort
                                                : Status::kRecord;
    EXPECT_EQ(stream.next(), expected) << size;
    EXPECT_EQ(stream.offset(), size);
    EXPECT_TRUE(std::string_view("data").starts_with(stream.record().data));
  }
}

TEST(Rosbag1Records, StreamTellsHowMuchIsMissing) {
  std::istringstream input(Bytes().block(kHeader).number(1'000'000'000u).raw("data").text());
  RecordStream stream(input);
  EXPECT_EQ(stream.next(), Status::kCutShort);
  EXPECT_EQ(stream.missing_bytes(), 999'999'996u);
  EXPECT_EQ(stream.record().data, "data");
}

TEST(Rosbag1Records, ImpossibleHeadersAreDamage) {
  std::istringstream too_long(Bytes().number(0xffffffffu).raw("xxxx").text());
  EXPECT_EQ(RecordStream(too_long).next(), Status::kDamaged);
  std::istringstream without_op(Bytes().block("").block("").text());
  EXPECT_EQ(RecordStream(without_op).next(), Status::kDamaged);
}

TEST(Rosbag1Records, SeeksWithinTheBagOnly) {
  std::istringstream input("before" + Bytes().block(kHeader).block("data").text());
  input.ignore(6);
  RecordStream stream(input);
  ASSERT_EQ(stream.next(), Status::kRecord);
  const std::uint64_t end = stream.offset();
  EXPECT_FALSE(stream.seek(end + 1));
  EXPECT_EQ(stream.offset(), end);
  EXPECT_EQ(stream.next(), Status::kEnd);
  ASSERT_TRUE(stream.seek(0));
  EXPECT_EQ(stream.next(), Status::kRecord);
}

}  // namespace
}  // namespace cairn::rosbag1
