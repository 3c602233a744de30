#include "cairn/io/pose_collector.hpp"

#include "cairn/core/errors.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Trajectory collect(const std::vector<double>& stamps, Diagnostics& diagnostics,
                   const std::string& text = "\n") {
  std::istringstream input(text);
  LineReader lines(input, "f");
  lines.next();
  PoseCollector poses;
  double x = 0.0;
  for (const double t : stamps) poses.add(time_from_seconds(t), {x++, 0, 0}, lines, diagnostics);
  return poses.finish(lines, diagnostics);
}

TEST(PoseCollector, SortsAndCountsStampsThatRunBackwards) {
  Diagnostics diagnostics;
  const Trajectory poses = collect({1, 3, 2, 4, 0}, diagnostics);
  ASSERT_EQ(poses.size(), 5u);
  EXPECT_EQ(poses[0].pose.x, 4.0);
  EXPECT_EQ(poses[2].pose.x, 2.0);
  EXPECT_EQ(diagnostics.counts().at("stamp runs backwards"), 2);
}

TEST(PoseCollector, KeepsTheFirstOfEqualStampsAndCountsTheRest) {
  Diagnostics diagnostics;
  const Trajectory poses = collect({1, 2, 2, 2, 3}, diagnostics);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[1].pose.x, 1.0);
  EXPECT_EQ(diagnostics.counts().at("duplicate stamp"), 2);
}

TEST(PoseCollector, WarnsOfALastLineWithoutEnd) {
  Diagnostics whole, cut;
  collect({1}, whole, "line\n");
  collect({1}, cut, "line");
  EXPECT_TRUE(whole.empty());
  EXPECT_EQ(cut.counts().at("last line has no end"), 1);
}

TEST(PoseCollector, WarnsOfCentimetres) {
  // collect() makes x the position in the file: stamps one second apart move at 1 m/s, a hundredth of it at
  // 100.
  std::vector<double> slow, fast;
  for (int i = 0; i < 2000; ++i) {
    slow.push_back(i);
    fast.push_back(0.01 * i);
  }
  Diagnostics metres, centimetres;
  collect(slow, metres);
  collect(fast, centimetres);
  EXPECT_TRUE(metres.empty());
  EXPECT_EQ(centimetres.counts().at("implausible units"), 1);
}

TEST(PoseCollector, RefusesAFileWithoutPoses) {
  Diagnostics diagnostics;
  EXPECT_THROW(collect({}, diagnostics), InputError);
}

TEST(NextDataLine, PassesOverBlankLinesAndComments) {
  std::istringstream input("# a\n\n  \t\n  # b\n 1 2\n");
  LineReader lines(input, "f");
  ASSERT_TRUE(next_data_line(lines));
  EXPECT_EQ(lines.number(), 5);
  EXPECT_FALSE(next_data_line(lines));
}

}  // namespace
}  // namespace cairn
