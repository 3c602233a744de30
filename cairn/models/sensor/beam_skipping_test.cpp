#include "cairn/models/sensor/beam_skipping.hpp"

#include "cairn/models/registry.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Pose2 kTruth{2.0, 1.2, 0.4};
const Pose2 kTBaseSensor{0.15, -0.05, 0.3};

const MapSet& room() {
  static const MapSet maps(std::make_shared<const OccupancyGrid>(test::mini_room()));
  return maps;
}

BeamSkipping skipping(const BeamSkippingOptions& options = {}) {
  static const auto field = std::make_shared<const DistanceField>(*room().grid(), 2.0);
  return {field, kTBaseSensor, {}, options};
}

LaserScan scan_at_truth() { return test::scan_of(*room().grid(), kTruth * kTBaseSensor, 180); }

// People stand close to the robot over a third of the beams.
LaserScan crowded(LaserScan scan) {
  for (std::size_t i = 0; i < scan.ranges_m.size() / 3; ++i)
    scan.ranges_m[i] = std::min(scan.ranges_m[i], 0.5f);
  return scan;
}

std::vector<Pose2> belief_about(const Pose2& center) {
  const RandomStream random(7, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto n = random.normal4(i);
    poses.push_back(center * Pose2{0.05 * n[0], 0.05 * n[1], 0.02 * n[2]});
  }
  return poses;
}

std::size_t left_out(const LaserScan& scan) {
  return static_cast<std::size_t>(std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(),
                                                [](float range) { return std::isnan(range); }));
}

std::vector<double> scores(const LaserScan& scan, const std::vector<Pose2>& poses) {
  static const auto model =
      make_laser_model("likelihood_field_prob", {room(), kTBaseSensor, {}, LaserModelOptions{}});
  std::vector<double> out(poses.size());
  model->log_likelihood(scan, poses, out);
  return out;
}

TEST(BeamSkipping, KeepsWhatTheMapExpects) {
  EXPECT_EQ(left_out(skipping().expected_part(scan_at_truth(), belief_about(kTruth))), 0u);
}

TEST(BeamSkipping, LeavesOutWhatStandsInFreeSpace) {
  const LaserScan scan = crowded(scan_at_truth());
  const LaserScan expected = skipping().expected_part(scan, belief_about(kTruth));
  const DistanceField field(*room().grid(), 2.0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const Point2 end{scan.ranges_m[i] * std::cos(angle), scan.ranges_m[i] * std::sin(angle)};
    const Point2 cell = field.geometry().to_cells(kTruth * kTBaseSensor * end);
    const double distance =
        field.distance_m(field.geometry().index(static_cast<int>(cell.x), static_cast<int>(cell.y)));
    if (distance > 0.3 && distance < 0.7) continue;  // in some states near, in some not
    EXPECT_EQ(std::isnan(expected.ranges_m[i]), distance > 0.7) << i;
  }
  EXPECT_GT(left_out(expected), 10u);
}

TEST(BeamSkipping, CountsAllBeamsWhereTheBeliefItselfIsWrong) {
  LaserScan scan = scan_at_truth();
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), 0.8f);  // nothing of the map is so near
  const auto wrong = belief_about({5.0, 2.5, 2.5});
  EXPECT_EQ(left_out(skipping({.distance_m = 0.1}).expected_part(scan, wrong)), 0u);
  EXPECT_GT(left_out(skipping({.distance_m = 0.1, .error_threshold = 0.95}).expected_part(scan, wrong)),
            150u);
}

TEST(BeamSkipping, LeavesTheScanAsItIsWithoutABelief) {
  const LaserScan scan = crowded(scan_at_truth());
  EXPECT_EQ(skipping().expected_part(scan, {}).ranges_m, scan.ranges_m);
}

// A trolley in front of a wall looks like a wall that is nearer: the beams on it pull the belief away.
TEST(BeamSkipping, AnObstacleThatLooksLikeAWallDoesNotPull) {
  LaserScan scan = scan_at_truth();
  const Pose2 T_map_sensor = kTruth * kTBaseSensor;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {  // everything beyond y = 0.6 m is hidden
    const double angle =
        T_map_sensor.theta + scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const double range = (0.6 - T_map_sensor.y) / std::sin(angle);
    if (std::sin(angle) < -0.1 && range < scan.ranges_m[i]) scan.ranges_m[i] = static_cast<float>(range);
  }
  const std::vector<Pose2> poses{kTruth, {kTruth.x, kTruth.y - 0.55, kTruth.theta}};  // the board on the wall
  const std::vector<Pose2> belief = belief_about(kTruth);
  const auto gain = [&](const LaserScan& read) {
    const auto s = scores(read, poses);
    return s[0] - s[1];
  };
  EXPECT_GT(gain(skipping({.distance_m = 0.3}).expected_part(scan, belief)), gain(scan) + 3.0);
}

TEST(BeamSkipping, SurvivesWhatNoScannerSays) {
  std::vector<Pose2> nowhere = belief_about(kTruth);
  nowhere[0] = {std::nan(""), 0.0, 0.0};
  nowhere[1] = {1e300, -1e300, 1e300};
  for (const float range : {0.0f, -1.0f, std::nanf(""), HUGE_VALF}) {
    LaserScan scan = scan_at_truth();
    std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), range);
    EXPECT_EQ(skipping().expected_part(scan, nowhere).ranges_m.size(), scan.ranges_m.size());
  }
  LaserScan empty = scan_at_truth();
  empty.ranges_m.clear();
  EXPECT_TRUE(skipping().expected_part(empty, nowhere).ranges_m.empty());
}

}  // namespace
}  // namespace cairn
