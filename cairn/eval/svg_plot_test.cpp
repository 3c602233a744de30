#include "cairn/eval/svg_plot.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(SvgPlot, DrawsLinesDotsAndNames) {
  const SvgPlot plot{"a < b",
                     {"x [m]"},
                     {"share"},
                     false,
                     {{"one", {{0, 0}, {10, 1}}}, {"two", {{5, 0.5}, {7, 0.6}}, true}}};
  const std::string svg = render_svg(std::span(&plot, 1), 1);
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr("points=\"62.0,246.0 368.0,30.0 \"")) << "corner to corner";
  EXPECT_EQ(count(svg, "<circle"), 2U);
  EXPECT_THAT(svg, HasSubstr(">two</text>"));
}

TEST(SvgPlot, LeavesOutWhatHasNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const SvgPlot plot{
      "", {"", true}, {"", true}, false, {{"", {{0, 1}, {1, nan}, {-1, 1}, {1, 1}, {100, 10}}, true}}};
  const std::string svg = render_svg(std::span(&plot, 1), 1);
  EXPECT_EQ(count(svg, "<circle"), 2U);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(SvgPlot, AnEmptyPanelIsAnEmptyPanel) {
  const SvgPlot plots[3] = {};
  const std::string svg = render_svg(plots, 2);
  EXPECT_THAT(svg, HasSubstr("width=\"760.0\" height=\"580.0\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, AMetreIsAsLongOnBothAxes) {
  const SvgPlot plot{"", {}, {}, true, {{"", {{0, 0}, {1, 0}, {0, 10}}, true}}};
  const std::string svg = render_svg(std::span(&plot, 1), 1);
  // 10 m over 216 units: the point one metre aside lies 21.6 beside the first, at the middle of the panel.
  EXPECT_THAT(svg, HasSubstr("cx=\"204.2\""));
  EXPECT_THAT(svg, HasSubstr("cx=\"225.8\""));
}

}  // namespace
}  // namespace cairn
