#include "cairn/models/sensor/beam_selection.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Beam i looks at i degrees from the right and measured 1 + i / 1000 metres, so that a point tells its beam.
LaserScan half_circle(int beams = 181) {
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = degrees_to_radians(1.0);
  scan.range_min_m = 0.05;
  scan.range_max_m = 20.0;
  for (int i = 0; i < beams; ++i) scan.ranges_m.push_back(1.0f + 1e-3f * static_cast<float>(i));
  return scan;
}

std::vector<int> beams_of(const std::vector<Point2>& points) {
  std::vector<int> beams;
  for (const Point2& p : points)
    beams.push_back(static_cast<int>(std::lround((std::hypot(p.x, p.y) - 1.0) * 1e3)));
  return beams;
}

std::vector<int> selected(const LaserScan& scan, int max_beams, const BeamLimits& limits = {}) {
  return beams_of(select_end_points(scan, {}, limits, max_beams));
}

TEST(BeamSelection, EndPointsByHand) {
  LaserScan scan = half_circle(3);
  scan.angle_increment_rad = kPi / 2.0;
  scan.ranges_m = {1.0f, 2.0f, 3.0f};
  const auto points = select_end_points(scan, {10.0, 20.0, kPi / 2.0}, {}, 0);
  ASSERT_EQ(points.size(), 3u);
  const Point2 expected[] = {
      {11.0, 20.0}, {10.0, 22.0}, {7.0, 20.0}};  // right, ahead, left of a turned sensor
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(points[i].x, expected[i].x, 1e-12) << i;
    EXPECT_NEAR(points[i].y, expected[i].y, 1e-12) << i;
  }
}

TEST(BeamSelection, ANegativeIncrementMirrors) {
  LaserScan scan = half_circle(2);
  scan.angle_min_rad = kPi / 2.0;
  scan.angle_increment_rad = -kPi / 2.0;
  const auto points = select_end_points(scan, {}, {}, 0);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].y, 1.0, 1e-6);    // left
  EXPECT_NEAR(points[1].x, 1.001, 1e-6);  // ahead
}

TEST(BeamSelection, ZeroMeansAll) {
  EXPECT_EQ(selected(half_circle(), 0).size(), 181u);
  EXPECT_EQ(selected(half_circle(), 500).size(), 181u);
  EXPECT_EQ(selected(half_circle(), 181).size(), 181u);
}

TEST(BeamSelection, IsEvenAndCentred) {
  EXPECT_EQ(selected(half_circle(180), 3), (std::vector<int>{30, 90, 150}));
  EXPECT_EQ(selected(half_circle(180), 1), (std::vector<int>{90}));
  for (const int wanted : {2, 7, 60, 179}) {
    const auto beams = selected(half_circle(), wanted);
    ASSERT_EQ(beams.size(), static_cast<std::size_t>(wanted));
    const double spacing = 181.0 / wanted;
    for (int k = 0; k < wanted; ++k)
      EXPECT_NEAR(beams[static_cast<std::size_t>(k)] + 0.5, (k + 0.5) * spacing, 0.5 + 1e-9);
  }
}

TEST(BeamSelection, InvalidBeamsAreDroppedBeforeTheChoice) {
  LaserScan scan = half_circle(180);
  const float bad[] = {0.0f, 25.0f, -1.0f, std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t i = 0; i < 180; ++i) {
    if (i % 3 != 0) scan.ranges_m[i] = bad[i % 5];
  }
  const auto beams = selected(scan, 30);
  EXPECT_EQ(beams.size(), 30u);  // of the 60 valid ones every second
  for (std::size_t k = 0; k < beams.size(); ++k) EXPECT_EQ(beams[k], static_cast<int>(3 * (2 * k + 1)));
}

TEST(BeamSelection, LimitsOfTheModel) {
  const auto beams = selected(half_circle(), 0, {.min_range_m = 1.0495, .max_range_m = 1.0995});
  ASSERT_EQ(beams.size(), 50u);
  EXPECT_EQ(beams.front(), 50);
  EXPECT_EQ(beams.back(), 99);
  EXPECT_TRUE(selected(half_circle(), 0, {.min_range_m = 5.0, .max_range_m = 6.0}).empty());
}

TEST(BeamSelection, NoValidBeamGivesNoPoint) {
  LaserScan scan = half_circle();
  scan.ranges_m.assign(181, 0.0f);
  EXPECT_TRUE(selected(scan, 60).empty());
  scan.ranges_m.clear();
  EXPECT_TRUE(selected(scan, 60).empty());
}

}  // namespace
}  // namespace cairn
