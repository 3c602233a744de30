#include "cairn/io/wean_map.hpp"

#include "bad_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

const std::string kHeader =
    "robot_specifications->global_mapsize_x   30\nrobot_specifications->resolution   10\n"
    "robot_specifications->autoshifted_x  0\n\n";
const std::string kMap = kHeader + "global_map[0]: 3 2\n1.0 0.0 \n-1.000 0.25\n0.5 1.0\n";

OccupancyGrid read(std::istream& input) { return read_wean_map(input, "f"); }
std::string error_of(const std::string& text) { return test::error_on(read, text); }

TEST(WeanMap, LinesAreXAndValuesAreFree) {
  std::istringstream input(kMap);
  const OccupancyGrid grid = read(input);
  EXPECT_EQ(grid.geometry().width, 3);
  EXPECT_EQ(grid.geometry().height, 2);
  EXPECT_DOUBLE_EQ(grid.geometry().resolution_m, 0.1);
  EXPECT_EQ(grid.state_at({0.05, 0.05}), CellState::kFree);
  EXPECT_EQ(grid.state_at({0.05, 0.15}), CellState::kOccupied);
  EXPECT_EQ(grid.state_at({0.15, 0.05}), CellState::kUnknown);
  EXPECT_EQ(grid.cells()[grid.geometry().index(1, 1)], 75);
  EXPECT_EQ(grid.cells()[grid.geometry().index(2, 0)], 50);
}

TEST(WeanMap, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of(""), HasSubstr("has no line 'global_map"));
  EXPECT_THAT(error_of("P5\n"), HasSubstr("f:1:1: this is no line of a Wean map's header"));
  EXPECT_THAT(error_of("global_map[0]: 1 1\n1\n"),
              HasSubstr("has no line 'robot_specifications->resolution'"));
  EXPECT_THAT(error_of("robot_specifications->resolution 0\n"), HasSubstr("resolution is out of range"));
  EXPECT_THAT(error_of("robot_specifications->resolution nan\n"), HasSubstr("not finite"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 1000000000 1000000000\n1 1\n"),
              HasSubstr("more cells than"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: -3 2\n1 1\n"), HasSubstr("width is out of range"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 0 2\n1 1\n"), HasSubstr("width is out of range"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 1 2\n1 wall\n"), HasSubstr("f:6:3: 'wall'"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 1 2\n1 1.5\n"), HasSubstr("neither -1 nor within 0..1"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 1 2\n1 nan\n"), HasSubstr("not finite"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 1 2\n1 1 1\n"), HasSubstr("f:6:5: more cells follow"));
  EXPECT_THAT(error_of(kHeader + "global_map[0]: 2 2\n1 1\n1\n"), HasSubstr("ends after 3 of 4 cells"));
}

TEST(WeanMap, AcceptsOnlyCutsWithinTheLastNumber) {
  EXPECT_EQ(test::accepted_cuts(read, kMap), 3u);  // "1", "1." and "1.0" without line end
}

}  // namespace
}  // namespace cairn
