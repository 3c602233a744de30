#include "cairn/io/log_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/io/mcap_log_writer.hpp"
#include "log_inspection.hpp"
#include "test_data.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string format_of(const std::string& text) {
  std::istringstream input(text);
  return read_log(input, "a").format;
}

std::string error_of(const std::string& text) {
  std::istringstream input(text);
  try {
    read_log(input, "a");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kOdom = "ODOM 1 2 0.5 0.1 0.2 0 11.5 nohost 0.5\n";

TEST(LogReader, KnowsTextLogsByTheirLines) {
  EXPECT_EQ(format_of(kOdom), "carmen");
  EXPECT_EQ(format_of("\n# comment\r\nSYNC x 0 h 0\r\n" + kOdom), "carmen");
  EXPECT_EQ(format_of("O 1 2 3 4\n"), "wean");
  EXPECT_EQ(format_of("FRAME 0\nLASER 1 2 80 3 0 0 0 1 2\n"), "mrpt_text");
}

TEST(LogReader, KnowsBagsByTheirFirstBytes) {
  std::ostringstream mcap;
  write_mcap_log(mcap, {});
  EXPECT_EQ(format_of(mcap.str()), "mcap");
  EXPECT_THAT(error_of("\x89MCAP0\r\n"), HasSubstr("header of the MCAP file is damaged or cut short"));
  EXPECT_THAT(error_of(std::string("SQLite format 3\0", 16)), HasSubstr("ends within its header"));
  EXPECT_THAT(error_of("#ROSBAG V2.0\n"), HasSubstr("bag's header"));
}

TEST(LogReader, DamagedFirstLineDoesNotDecide) {
  EXPECT_EQ(format_of("0.25 nohost 0.1\n" + kOdom + kOdom), "carmen");
}

TEST(LogReader, DamagedBytesAreNoNoise) {
  EXPECT_EQ(format_of(std::string(3, '\0') + "\n" + kOdom + kOdom), "carmen");
}

// Nearly every one of these has a line that begins with a reader's one-letter word.
TEST(LogReader, NoiseIsNoTextLog) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomStream random(seed, RandomPurpose::kInitialize, 0);
    std::string noise;
    for (std::uint32_t i = 0; i < 20000; ++i) noise += static_cast<char>(256.0 * random.uniform(i) - 128.0);
    EXPECT_THAT(error_of(noise), HasSubstr("known format")) << "seed " << seed;
  }
}

TEST(LogReader, BagGoesToTheBagReader) {
  EXPECT_THAT(error_of("#ROSBAG V2.0\n"), Not(HasSubstr("known format")));
  EXPECT_NE(error_of("#ROSBAG V2.0\n"), "no error");
}

TEST(LogReader, OtherContentSaysHowItBegins) {
  EXPECT_THAT(error_of("hello world\n"),
              AllOf(HasSubstr("begins with \"hello world\\x0a\""), HasSubstr("CARMEN")));
  EXPECT_THAT(error_of("\x89PNG\r\n"), HasSubstr("\"\\x89PNG\\x0d\\x0a\""));
  EXPECT_THAT(error_of("hello world\n"), HasSubstr("ROS 2 bag"));
  EXPECT_THAT(error_of(""), HasSubstr("begins with \"\""));
  EXPECT_LT(error_of(std::string(100000, '\x01')).size(), 300U);
}

struct Recording {
  const char* file;
  const char* format;
  const char* laser;
};

class LogReaderRecording : public ::testing::TestWithParam<Recording> {};

TEST_P(LogReaderRecording, IsKnown) {
  CAIRN_SKIP_WITHOUT(GetParam().file);
  const Log log = read_log(test::data_file(GetParam().file));
  EXPECT_EQ(log.format, GetParam().format);
  EXPECT_GT(test::messages_by_stream(log)[GetParam().laser], 100U);
  EXPECT_EQ(test::count(log, "implausible units"), 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, LogReaderRecording,
                         ::testing::Values(Recording{"radish_raw/aces.clf.bz2", "carmen", "flaser"},
                                           Recording{"radish_derived/edmonton.log.gz", "carmen", "flaser"},
                                           Recording{"wean/robotdata1.log", "wean", "laser"},
                                           Recording{"mrpt_uwb_laser/log.txt", "mrpt_text", "laser"}));

}  // namespace
}  // namespace cairn
