#include "cairn/io/trajectory_reader.hpp"

#include "bad_input.hpp"
#include "test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::error_on;
using ::testing::HasSubstr;

Trajectory read(std::istream& input) {
  Diagnostics diagnostics;
  return read_trajectory(input, "f", {}, diagnostics);
}

Trajectory read_text(const std::string& text) {
  std::istringstream input(text);
  return read(input);
}

TEST(ReadTrajectory, TellsTheFormatByContent) {
  const Trajectory expected = {{time_from_seconds(1.5), {2, 3, 0}}};
  EXPECT_EQ(read_text("# tum\n1.5 2 3 0 0 0 0 1\n"), expected);
  EXPECT_EQ(read_text("1.5 2 3 0\n"), expected);
  EXPECT_EQ(read_text("\n1.5, 2, 3, 0\n"), expected);
  EXPECT_EQ(read_text("# CARMEN\nPARAM a b\nFLASER 0 2 3 0 0 0 0 1.5 h 0\n"), expected);
}

TEST(ReadTrajectory, NumberedPosesNeedTheFramesOfTheLog) {
  const std::string text = "0 2 3 0\n1 2 3 0\n";
  EXPECT_THAT(error_on(read, text), HasSubstr("numbered"));
  std::istringstream input(text);
  Diagnostics diagnostics;
  const std::vector<Time> frames = {time_from_seconds(7), time_from_seconds(8), time_from_seconds(9)};
  const Trajectory poses = read_trajectory(input, "f", {.frame_stamps = frames}, diagnostics);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].stamp, frames[1]);
}

TEST(ReadTrajectory, RefusesWhatIsNoTrajectory) {
  EXPECT_THAT(error_on(read, ""), HasSubstr("no pose"));
  EXPECT_THAT(error_on(read, "1 2 3 4 5\n"), HasSubstr("f:1: a line of 5 fields"));
  EXPECT_THAT(error_on(read, "begin 2 3 4\n"), HasSubstr("f:1:1: 'begin'"));
  EXPECT_THAT(error_on(read, std::string("\x89PNG\r\n\x1a\n\0\0", 10)), HasSubstr("f:1"));
}

TEST(ReadTrajectory, DirectoryAndMissingFileAreErrors) {
  EXPECT_THROW(read_trajectory(std::filesystem::temp_directory_path()), InputError);
  EXPECT_THROW(read_trajectory("/no/such/file.tum"), InputError);
}

TEST(ReadTrajectory, ReadsTheRealFiles) {
  const std::vector<std::pair<const char*, std::size_t>> files = {
      {"radish_reference/intel_reference_dense.txt", 13000},
      {"radish_derived/aces.ref.txt", 100},
      {"jarvis_nav350/text/complex_gt.txt", 500},
      {"wean/robotdata101.log", 1000},
      {"rawseeds_eval/Bicocca_2009-02-25a/Bicocca_2009-02-25a-GROUNDTRUTH.csv", 1000}};
  for (const auto& [name, at_least] : files) {
    CAIRN_SKIP_WITHOUT(name);
    EXPECT_GE(read_trajectory(test::data_file(name)).size(), at_least) << name;
  }
}

}  // namespace
}  // namespace cairn
