#include "cairn/io/beam_text.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<Point2> read(const std::string& text) {
  std::istringstream input(text);
  return read_beams(input, "scan.txt");
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BeamText, ReadsBearingAndRange) {
  const auto points =
      read("# bearing range\n0 2\r\n1.5707963267948966, 3.5\n\n-0.5 inf\n0.1 nan\n0.2 0\n0.3 -1\n");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].x, 2.0, 1e-12);
  EXPECT_NEAR(points[1].x, 0.0, 1e-12);
  EXPECT_NEAR(points[1].y, 3.5, 1e-12);
}

TEST(BeamText, SaysWhatIsWrongAndWhere) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of("0 1\n0.1 near\n"), HasSubstr("scan.txt:2:5"));
  EXPECT_THAT(error_of("0\n"), HasSubstr("range"));
  EXPECT_THAT(error_of("nan 1\n"), HasSubstr("scan.txt:1:1"));
  EXPECT_THAT(error_of("0 1 2\n"), HasSubstr("scan.txt:1"));
  EXPECT_THAT(error_of("180 1\n"), HasSubstr("radians"));
  EXPECT_THAT(error_of("0 20000\n"), HasSubstr("metres"));
  EXPECT_THAT(error_of(""), HasSubstr("no beam"));
  EXPECT_THAT(error_of("0 inf\n"), HasSubstr("no beam"));
}

}  // namespace
}  // namespace cairn
