#include "cairn/io/rosbag1.hpp"

#include "cairn/core/errors.hpp"
#include "rosbag_writer.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::Bytes;
using test::RosbagWriter;

Log read(const std::string& bag) {
  std::istringstream input(bag);
  return read_rosbag1(input, "test.bag");
}

std::int64_t count(const Log& log, const std::string& kind) {
  const auto found = log.diagnostics.counts().find(kind);
  return found == log.diagnostics.counts().end() ? 0 : found->second;
}

std::string error_of(const std::string& bag) {
  try {
    read(bag);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Three chunks, two scans each; every scan has its number as first range.
struct SmallBag {
  explicit SmallBag(const std::string& compression, bool indexed = true) : writer(compression, indexed) {
    const auto laser = writer.connection("/scan", "sensor_msgs/LaserScan", test::kLaserScanMd5);
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::vector<float> ranges{static_cast<float>(i), 2.0f, std::nanf("")};
      writer.message(laser, {100 + i, 500}, test::scan_message({.stamp = {100 + i, 0}, .ranges = ranges}));
      if (i % 2 == 1) writer.end_chunk();
    }
    bag = writer.finish();
  }
  RosbagWriter writer;
  std::string bag;
};

std::vector<int> scan_numbers(const Log& log) {
  std::vector<int> numbers;
  for (const Event& event : log.events) {
    numbers.push_back(
        static_cast<int>(std::get<std::shared_ptr<const LaserScan>>(event.payload)->ranges_m.at(0)));
  }
  return numbers;
}

class AnyCompression : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Rosbag1, AnyCompression, testing::Values("none", "bz2", "lz4"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(AnyCompression, ReadsAllMessagesInOrder) {
  const Log log = read(SmallBag(GetParam()).bag);
  EXPECT_EQ(log.format, "rosbag1");
  ASSERT_EQ(log.streams.size(), 1u);
  EXPECT_EQ(log.streams[0].name, "/scan");
  EXPECT_EQ(log.streams[0].frame, "laser");
  EXPECT_THAT(scan_numbers(log), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(log.events[3].stamp, Time(std::chrono::seconds(103)));
  EXPECT_EQ(log.events[3].arrival, Time(std::chrono::seconds(103) + std::chrono::nanoseconds(500)));
  EXPECT_EQ(log.diagnostics.counts(), (std::map<std::string, std::int64_t>{{"unknown mount", 1}}));
}

TEST_P(AnyCompression, CutAtEveryByteGivesAPrefixAndSaysSo) {
  const SmallBag small(GetParam());
  const std::vector<int> all{0, 1, 2, 3, 4, 5};
  std::size_t most = 0;
  for (std::size_t size = 0; size < small.bag.size(); ++size) {
    SCOPED_TRACE(size);
    std::vector<int> numbers;
    try {
      const Log log = read(small.bag.substr(0, size));
      numbers = scan_numbers(log);
      EXPECT_EQ(count(log, "truncated"), 1);
      if (size < small.writer.index_offset()) {
        EXPECT_GE(count(log, "lost bytes"), static_cast<std::int64_t>(small.writer.index_offset() - size));
      }
      EXPECT_EQ(count(log, "corrupt chunk") + count(log, "damaged record"), 0);
    } catch (const InputError& error) {
      EXPECT_LT(size, small.writer.chunk_offsets()[0]) << error.what();
    }
    ASSERT_LE(numbers.size(), all.size());
    EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), all.begin()));
    EXPECT_GE(numbers.size(), most) << "more bytes gave fewer messages";
    most = numbers.size();
  }
  EXPECT_EQ(most, all.size());
}

TEST_P(AnyCompression, UnindexedBagIsReadWholeAtEveryCut) {
  const SmallBag small(GetParam(), false);
  const Log log = read(small.bag);
  EXPECT_EQ(log.events.size(), 6u);
  EXPECT_EQ(count(log, "unindexed"), 1);
  EXPECT_EQ(count(log, "truncated"), 0);
  for (std::size_t size = small.writer.chunk_offsets()[0]; size < small.bag.size(); ++size) {
    const Log cut = read(small.bag.substr(0, size));
    EXPECT_EQ(count(cut, "unindexed"), 1) << size;
    const auto& offsets = small.writer.chunk_offsets();
    const bool between_records = std::find(offsets.begin(), offsets.end(), size) != offsets.end();
    EXPECT_EQ(count(cut, "truncated"), between_records ? 0 : 1) << size;
  }
}

// A plain chunk has no checksum.
class PackedChunk : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Rosbag1, PackedChunk, testing::Values("bz2", "lz4"),
                         [](const auto& test) { return std::string(test.param); });

// The first chunk also holds the only connection record before the index.
TEST_P(PackedChunk, CorruptChunkIsLostAndCountedAndReadingGoesOn) {
  const SmallBag small(GetParam());
  for (std::size_t chunk = 0; chunk < 3; ++chunk) {
    SCOPED_TRACE(chunk);
    std::string bag = small.bag;
    for (std::size_t i = 20; i < 40; ++i) bag[small.writer.chunk_data_offsets()[chunk] + i] ^= 0x5a;
    const Log log = read(bag);
    EXPECT_EQ(count(log, "corrupt chunk"), 1);
    EXPECT_EQ(count(log, "lost messages"), 2);
    EXPECT_GT(count(log, "lost bytes"), 0);
    EXPECT_EQ(count(log, "message of an unknown connection"), 0);
    EXPECT_EQ(log.events.size(), 4u);
    EXPECT_THAT(scan_numbers(log), testing::Not(testing::Contains(static_cast<int>(2 * chunk))));
  }
}

TEST_P(AnyCompression, AnnouncedChunkSizeIsNotBelieved) {
  for (const std::uint32_t announced : {0u, 10u, 1u << 28, 0x7fffffffu, 0xffffffffu}) {
    SmallBag small(GetParam());
    std::string bag = small.bag;
    const std::size_t field = bag.find("size=", small.writer.chunk_offsets()[1]) + 5;
    bag.replace(field, 4, Bytes().number(announced).text());
    const Log log = read(bag);
    EXPECT_EQ(count(log, "corrupt chunk"), 1) << announced;
    EXPECT_THAT(scan_numbers(log), testing::ElementsAre(0, 1, 4, 5));
  }
}

TEST_P(AnyCompression, NoFlippedByteCrashes) {
  const SmallBag small(GetParam());
  for (std::size_t i = 0; i < small.bag.size(); ++i) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string bag = small.bag;
      bag[i] ^= flip;
      try {
        EXPECT_LE(read(bag).events.size(), 6u);
      } catch (const InputError& error) {
        EXPECT_LT(i, small.writer.chunk_offsets()[0]) << error.what();
      }
    }
  }
}

TEST(Rosbag1, DamagedRecordLengthCostsOneChunkWhereAnIndexTellsTheNext) {
  const SmallBag small("none");
  for (const std::uint32_t length : {0u, 100u, 0x7fffffffu, 0xffffffffu}) {
    std::string bag = small.bag;
    bag.replace(small.writer.chunk_offsets()[1], 4, Bytes().number(length).text());
    const Log log = read(bag);
    EXPECT_THAT(scan_numbers(log), testing::ElementsAre(0, 1, 4, 5)) << length;
    EXPECT_EQ(count(log, "damaged record"), 1);
    EXPECT_EQ(count(log, "lost messages"), 2);
    EXPECT_EQ(count(log, "lost bytes"), small.writer.chunk_offsets()[2] - small.writer.chunk_offsets()[1]);
  }
}

TEST(Rosbag1, DamagedRecordLengthWithoutIndexLosesTheRest) {
  const SmallBag small("none", false);
  std::string bag = small.bag;
  bag.replace(small.writer.chunk_offsets()[1], 4, Bytes().number(0xffffffffu).text());
  const Log log = read(bag);
  EXPECT_THAT(scan_numbers(log), testing::ElementsAre(0, 1));
  EXPECT_EQ(count(log, "damaged record"), 1);
  EXPECT_EQ(count(log, "lost bytes"), small.bag.size() - small.writer.chunk_offsets()[1]);
}

TEST(Rosbag1, DamageWithinAPlainChunkLosesItsRest) {
  RosbagWriter writer;
  const auto laser = writer.connection("/scan", "sensor_msgs/LaserScan", test::kLaserScanMd5);
  writer.message(laser, {100, 0}, test::scan_message({}));
  writer.raw(Bytes().number(0xfffffff0u).text());
  writer.message(laser, {101, 0}, test::scan_message({.stamp = {101, 0}}));
  const Log log = read(writer.finish());
  EXPECT_EQ(log.events.size(), 1u);
  EXPECT_EQ(count(log, "damaged record"), 1);
  EXPECT_EQ(count(log, "lost messages"), 1);
}

TEST(Rosbag1, MessagesOfAnUnknownConnectionAreCounted) {
  RosbagWriter writer;
  writer.message(7, {100, 0}, test::scan_message({}));
  const Log log = read(writer.finish());
  EXPECT_EQ(count(log, "message of an unknown connection"), 1);
  EXPECT_TRUE(log.events.empty());
}

// Reads forward only, as from a pipe.
class PipeBuffer : public std::streambuf {
 public:
  explicit PipeBuffer(std::string text) : text_(std::move(text)) {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

 private:
  std::string text_;
};

TEST(Rosbag1, ReadsAStreamThatCannotSeek) {
  PipeBuffer buffer(SmallBag("bz2").bag);
  std::istream input(&buffer);
  EXPECT_THAT(scan_numbers(read_rosbag1(input, "pipe")), testing::ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Rosbag1, ReadsABagThatBeginsWithinTheStream) {
  std::istringstream input("before" + SmallBag("lz4").bag);
  input.ignore(6);
  EXPECT_EQ(read_rosbag1(input, "inner").events.size(), 6u);
}

TEST(Rosbag1, TellsWhatIsNoBag) {
  EXPECT_THAT(error_of(""), testing::HasSubstr("not a ROS 1 bag"));
  EXPECT_THAT(error_of("FLASER 180 1.0\n"), testing::HasSubstr("not a ROS 1 bag"));
  EXPECT_THAT(error_of("#ROSBAG V1.2\nxyz"), testing::HasSubstr("format other than 2.0"));
  EXPECT_THAT(error_of("#ROSBAG"), testing::HasSubstr("ends within its first line"));
  EXPECT_THAT(error_of("#ROSBAG V2.0\n"), testing::HasSubstr("header is damaged or cut short"));
}

TEST(Rosbag1, RefusesAnEncryptedBag) {
  const std::string header = Bytes()
                                 .field("op", '\x03')
                                 .field("index_pos", std::uint64_t{0})
                                 .field("conn_count", 0u)
                                 .field("chunk_count", 0u)
                                 .field("encryptor", std::string_view("rosbag/AesCbcEncryptor"))
                                 .text();
  EXPECT_THAT(error_of("#ROSBAG V2.0\n" + Bytes().block(header).block("").text()),
              testing::HasSubstr("encrypted"));
}

TEST(Rosbag1, AChunkThatUnpacksToFarMoreThanItAnnouncesStopsEarly) {
  RosbagWriter bomb("bz2");
  bomb.raw(std::string(std::size_t{64} << 20, '\0'));
  bomb.end_chunk();
  std::string bag = bomb.finish();
  bag.replace(bag.find("size=", bomb.chunk_offsets()[0]) + 5, 4, Bytes().number(1000u).text());
  EXPECT_EQ(count(read(bag), "corrupt chunk"), 1);
}

TEST(Rosbag1, CentimetresReadAsMetresAreNoticed) {
  RosbagWriter writer;
  const auto laser = writer.connection("/scan", "sensor_msgs/LaserScan", test::kLaserScanMd5);
  const std::vector<float> ranges{310.0f, 450.0f, 520.0f};
  writer.message(laser, {100, 0}, test::scan_message({.range_max = 8000.0f, .ranges = ranges}));
  EXPECT_EQ(count(read(writer.finish()), "implausible units"), 1);
}

TEST(Rosbag1, IsToldByItsFirstBytes) {
  EXPECT_TRUE(is_rosbag1("#ROSBAG V2.0\n"));
  EXPECT_TRUE(is_rosbag1("#ROSBAG V1.1\n"));
  EXPECT_FALSE(is_rosbag1("#ROSB"));
  EXPECT_FALSE(is_rosbag1("# a CARMEN log"));
}

}  // namespace
}  // namespace cairn
