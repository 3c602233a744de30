#include "bad_input.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/mcap_reader.hpp"
#include "cairn/io/mcap_writer.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::mcap {
namespace {

struct Content {
  Header header;
  std::vector<std::string> messages;  // "topic sequence data"
  std::vector<std::string> channels;
  std::vector<Metadata> metadata;
  Diagnostics diagnostics;

  std::int64_t count(const std::string& kind) const {
    const auto found = diagnostics.counts().find(kind);
    return found == diagnostics.counts().end() ? 0 : found->second;
  }
};

Content read_from(std::istream& input) {
  Content content;
  Handlers handlers;
  handlers.on_channel = [&](const Schema& schema, const Channel& channel) {
    content.channels.push_back(channel.topic + " " + schema.name);
  };
  handlers.on_message = [&](const MessageView& m) {
    content.messages.push_back(m.channel.topic + " " + std::to_string(m.message.sequence) + " " +
                               std::string(m.message.data.substr(0, 3)));
  };
  handlers.on_metadata = [&](const Metadata& metadata) { content.metadata.push_back(metadata); };
  content.header = read(input, "a.mcap", handlers, content.diagnostics);
  return content;
}

Content read_bytes(const std::string& bytes) {
  std::istringstream input(bytes);
  return read_from(input);
}

std::string error_of(const std::string& bytes) {
  return test::error_on([](std::istream& input) { read_from(input); }, bytes);
}

// Three chunks of two messages each on two channels, long enough to be packed; metadata before and behind.
struct SmallFile {
  explicit SmallFile(Compression compression, bool is_closed = true) {
    Writer writer({"ros2", "test"}, compression);
    const auto take = [&] { bytes += writer.take(); };
    const std::uint16_t schema = writer.add_schema("pkg/msg/Type", "ros2msg", "int32 x");
    for (const char* topic : {"/a", "/b"})
      channels.push_back(writer.add_channel(schema, topic, "cdr", {{"k", "v"}}));
    writer.add_metadata({"first", {{"x", "1"}, {"y", ""}}});
    take();
    for (std::uint32_t i = 0; i < 6; ++i) {
      std::string data = "m" + std::to_string(i) + "-";
      for (std::size_t k = 0; k < 700; ++k) data += static_cast<char>('a' + (k * k + i) % 23);
      writer.add_message({channels[i % 2], i, 1000 - i, 7, data});
      expected.push_back(std::string(i % 2 == 0 ? "/a " : "/b ") + std::to_string(i) + " m" +
                         std::to_string(i) + "-");
      if (i % 2 == 0) continue;
      chunk_offsets.push_back(bytes.size());
      writer.end_chunk();
      take();
    }
    writer.add_metadata({"last", {}});
    take();
    data_end = bytes.size();
    if (is_closed) writer.finish();
    take();
  }
  std::string bytes;
  std::vector<std::uint16_t> channels;
  std::vector<std::string> expected;
  std::vector<std::size_t> chunk_offsets;
  std::size_t data_end = 0;
};

class McapCompression : public testing::TestWithParam<Compression> {};
INSTANTIATE_TEST_SUITE_P(Mcap, McapCompression,
                         testing::Values(Compression::kNone, Compression::kLz4, Compression::kZstd));

TEST_P(McapCompression, ReadsWhatWasWritten) {
  const SmallFile small(GetParam());
  const Content content = read_bytes(small.bytes);
  EXPECT_EQ(content.header.profile, "ros2");
  EXPECT_EQ(content.header.library, "test");
  EXPECT_EQ(content.messages, small.expected);
  EXPECT_THAT(content.channels, testing::ElementsAre("/a pkg/msg/Type", "/b pkg/msg/Type"));
  ASSERT_EQ(content.metadata.size(), 2U);
  EXPECT_EQ(content.metadata[0].values, (Texts{{"x", "1"}, {"y", ""}}));
  EXPECT_TRUE(content.diagnostics.empty());
}

TEST_P(McapCompression, CutAtEveryByteGivesAPrefixAndSaysSo) {
  const SmallFile small(GetParam());
  std::size_t most = 0;
  for (std::size_t size = 0; size < small.bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const std::string cut = small.bytes.substr(0, size);
    if (size < kMagic.size() + kRecordHeadBytes + 16) {
      EXPECT_NE(error_of(cut), "accepted");
      continue;
    }
    const Content content = read_bytes(cut);
    EXPECT_EQ(content.count("truncated") + content.count("unfinished"), 1);
    EXPECT_EQ(content.count("corrupt chunk") + content.count("damaged record"), 0);
    EXPECT_EQ(content.count("truncated") > 0, content.count("lost bytes") > 0);
    ASSERT_LE(content.messages.size(), small.expected.size());
    EXPECT_TRUE(std::equal(content.messages.begin(), content.messages.end(), small.expected.begin()));
    EXPECT_GE(content.messages.size(), most) << "more bytes gave fewer messages";
    most = content.messages.size();
    if (size >= small.data_end) {
      EXPECT_EQ(most, 6U);
    }
  }
}

TEST_P(McapCompression, AnUnfinishedFileIsReadWhole) {
  const Content content = read_bytes(SmallFile(GetParam(), false).bytes);
  EXPECT_EQ(content.messages.size(), 6U);
  EXPECT_EQ(content.count("unfinished"), 1);
  EXPECT_EQ(content.count("lost bytes"), 0);
}

TEST_P(McapCompression, ACorruptChunkIsLostAndCountedAndReadingGoesOn) {
  const SmallFile small(GetParam());
  for (std::size_t chunk = 0; chunk < 3; ++chunk) {
    std::string bytes = small.bytes;
    for (std::size_t i = 120; i < 140; ++i) bytes[small.chunk_offsets[chunk] + i] ^= 0x5a;
    const Content content = read_bytes(bytes);
    EXPECT_EQ(content.count("corrupt chunk"), 1);
    EXPECT_EQ(content.count("lost messages"), 2);
    EXPECT_GT(content.count("lost bytes"), 0);
    EXPECT_EQ(content.messages.size(), 4U);
    EXPECT_THAT(content.messages, testing::Not(testing::Contains(small.expected[2 * chunk])));
  }
}

TEST_P(McapCompression, ADamagedLengthCostsOneChunkWhereAnIndexTellsTheNext) {
  const SmallFile small(GetParam());
  for (const std::uint64_t length : {std::uint64_t{1} << 20, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::string bytes = small.bytes;
    bytes.replace(small.chunk_offsets[1] + 1, 8, Fields().number(length).bytes());
    const Content content = read_bytes(bytes);
    EXPECT_EQ(content.messages.size(), 4U);
    EXPECT_EQ(content.count("damaged record"), 1);
    EXPECT_EQ(content.count("lost messages"), 2);
  }
}

TEST_P(McapCompression, ADamagedLengthWithoutIndexLosesTheRestAndSaysSo) {
  const SmallFile small(GetParam(), false);
  std::string bytes = small.bytes;
  bytes.replace(small.chunk_offsets[1], 9, std::string(9, '\xff'));
  const Content content = read_bytes(bytes);
  EXPECT_EQ(content.messages.size(), 2U);
  EXPECT_EQ(content.count("lost bytes"), static_cast<std::int64_t>(bytes.size() - small.chunk_offsets[1]));
}

TEST_P(McapCompression, NoFlippedByteCrashes) {
  const SmallFile small(GetParam());
  for (std::size_t i = 0; i < small.bytes.size(); i += i % 7 == 0 ? 1 : 3) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string bytes = small.bytes;
      bytes[i] ^= flip;
      // A flipped opcode can make a message of one other record.
      test::is_accepted([](std::istream& input) { EXPECT_LE(read_from(input).messages.size(), 7U); }, bytes);
    }
  }
}

TEST(Mcap, AnnouncedSizesAreNotBelieved) {
  const SmallFile small(Compression::kLz4);
  for (const std::uint64_t announced : {std::uint64_t{0}, std::uint64_t{10}, std::uint64_t{1} << 27,
                                        std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::string bytes = small.bytes;
    bytes.replace(small.chunk_offsets[1] + kRecordHeadBytes + 16, 8, Fields().number(announced).bytes());
    const Content content = read_bytes(bytes);
    EXPECT_EQ(content.count("corrupt chunk"), 1) << announced;
    EXPECT_EQ(content.messages.size(), 4U);
  }
}

TEST(Mcap, MessagesOutsideOfChunksAreRead) {
  Writer writer({"", "test"}, Compression::kNone);
  const std::uint16_t channel = writer.add_channel(0, "/a", "json");
  const std::string bytes = writer.take() + record(Message{channel, 4, 0, 0, "xyz"});
  EXPECT_THAT(read_bytes(bytes).messages, testing::ElementsAre("/a 4 xyz"));
}

TEST(Mcap, MessagesOfAnUnknownChannelAreCounted) {
  const std::string bytes = Writer({"", "test"}, Compression::kNone).take() + record(Message{9, 0, 0, 0, ""});
  EXPECT_EQ(read_bytes(bytes).count("message of an unknown channel"), 1);
}

TEST(Mcap, RecordsOfOtherProgramsAreSkipped) {
  const std::string bytes =
      Writer({"", "test"}, Compression::kNone).take() + record(static_cast<Op>(0x90), "anything");
  EXPECT_EQ(read_bytes(bytes).diagnostics.counts(), (std::map<std::string, std::int64_t>{{"unfinished", 1}}));
}

TEST(Mcap, TellsWhatIsNoMcapFile) {
  EXPECT_THAT(error_of(""), testing::HasSubstr("not an MCAP file"));
  EXPECT_THAT(error_of("#ROSBAG V2.0\n"), testing::HasSubstr("not an MCAP file"));
  EXPECT_THAT(error_of("\x89MCAP1\r\n"), testing::HasSubstr("version other than 0"));
  EXPECT_THAT(error_of("\x89MC"), testing::HasSubstr("ends within its first bytes"));
  EXPECT_THAT(error_of(std::string(kMagic)), testing::HasSubstr("header of the MCAP file"));
  EXPECT_THAT(error_of(std::string(kMagic) + std::string(100, '\0')),
              testing::HasSubstr("header of the MCAP file"));
}

TEST(Mcap, TheFooterHasTheChecksumOfTheSummary) {
  const SmallFile small(Compression::kLz4);
  const std::string& bytes = small.bytes;
  const std::string_view footer = std::string_view(bytes).substr(bytes.size() - kMagic.size() - kFooterBytes);
  const auto parsed = parse_footer(footer.substr(kRecordHeadBytes)).value();
  const std::size_t end = bytes.size() - kMagic.size() - sizeof(std::uint32_t);
  EXPECT_EQ(parsed.summary_crc,
            crc32(std::string_view(bytes).substr(parsed.summary_start, end - parsed.summary_start)));
  EXPECT_EQ(crc32("123456789"), 0xcbf43926U);
}

TEST(Mcap, TimesBeyondItsRangeAreTheNearest) {
  EXPECT_EQ(to_mcap(Time(Duration(-5))), 0U);
  EXPECT_EQ(from_mcap(17), Time(Duration(17)));
  EXPECT_EQ(from_mcap(~std::uint64_t{0}), Time(Duration(kLastNanosecond)));
}

}  // namespace
}  // namespace cairn::mcap
