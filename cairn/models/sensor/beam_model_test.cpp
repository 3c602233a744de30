#include "cairn/models/sensor/beam_model.hpp"

#include "mini_maps.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kReach = 8.0;

BeamModelOptions options_of(double hit, double near, double none, double any) {
  BeamModelOptions options;
  options.z_hit = hit, options.z_short = near, options.z_max = none, options.z_rand = any;
  return options;
}

std::shared_ptr<const RayMarcher> room() {
  static const auto marcher = std::make_shared<const RayMarcher>(test::mini_room(), 20.0);
  return marcher;
}

TEST(BeamMixture, IsADensityBelowTheReachAndAProbabilityAtIt) {
  BeamModelOptions options = options_of(0.5, 0.3, 0.1, 0.3);  // weights need not add up to 1
  options.sigma_hit_m = 0.2;
  const BeamMixture mixture(options, kReach);
  for (const double expected : {0.9, 3.0, 7.9, 8.3, 1e9}) {
    constexpr int kSteps = 80'000;
    double total = mixture.terms(kReach, expected).sum();
    for (int i = 0; i < kSteps; ++i) {
      total += mixture.terms((i + 0.5) * kReach / kSteps, expected).sum() * kReach / kSteps;
    }
    // A short reading of a map beyond reach would be cut off: its share is lost there.
    const double near_beyond = expected <= kReach
                                   ? 0.0
                                   : 0.25 * (std::exp(-0.3 * kReach) - std::exp(-0.3 * expected)) /
                                         (1.0 - std::exp(-0.3 * expected));
    EXPECT_NEAR(total, 1.0 - near_beyond, 1e-4) << expected;
  }
}

TEST(BeamMixture, TheTermsAreThoseOfTheBook) {
  const BeamMixture mixture(options_of(0.25, 0.25, 0.25, 0.25), kReach);
  const auto t = mixture.terms(2.0, 3.0);
  EXPECT_NEAR(t.hit, 0.25 * std::exp(-0.5 * 100.0) / (0.1 * std::sqrt(2.0 * 3.14159265358979)), 1e-30);
  EXPECT_NEAR(t.unexpected, 0.25 * 0.3 * std::exp(-0.6) / (1.0 - std::exp(-0.9)), 1e-12);
  EXPECT_NEAR(t.rand, 0.25 / 8.0, 1e-12);
  EXPECT_EQ(t.max, 0.0);
  EXPECT_EQ(mixture.terms(3.1, 3.0).unexpected, 0.0);
  EXPECT_NEAR(mixture.terms(8.0, 8.0).hit, 0.125, 1e-12);  // half of the noise lies beyond the reach
}

// The double-precision formula over exact rays.
double reference(const BeamModelOptions& options, const LaserScan& scan, const Pose2& T_map_sensor) {
  static const OccupancyGrid grid = test::mini_room();
  const BeamMixture mixture(options, reach_m(scan, {}));
  double sum = 0.0;
  const auto readings = select_readings(scan, {}, options.max_beams);
  for (const BeamReading& reading : readings) {
    const Pose2 ray{T_map_sensor.x, T_map_sensor.y, T_map_sensor.theta + reading.bearing_rad};
    const double r = cast_ray(grid, ray, 20.0) + 0.5 * grid.geometry().resolution_m;
    sum += mixture.log_likelihood(reading.range_m, r < 20.0 ? r : 1e9);
  }
  return sum * std::min(1.0, options.effective_beams / static_cast<double>(readings.size()));
}

double score(const BeamModel& model, const LaserScan& scan, const Pose2& pose) {
  double out = std::nan("");
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

TEST(BeamModel, IsCloseToTheReference) {
  const BeamModelOptions options;
  const BeamModel model(room(), {}, {}, options);
  const Pose2 truth{2.013, 1.217, 0.4};
  LaserScan scan = test::scan_of(test::mini_room(), truth, 360);
  scan.range_max_m = 4.0;  // some beams have no return
  double largest = 0.0, total = 0.0;
  const RandomStream random(7, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto n = random.normal4(i);
    const Pose2 pose = truth * Pose2{0.2 * n[0], 0.2 * n[1], 0.1 * n[2]};
    const double error = std::abs(score(model, scan, pose) - reference(options, scan, pose));
    largest = std::max(largest, error);
    total += error;
  }
  EXPECT_LE(total / 200.0, 0.05);
  EXPECT_LE(largest, 0.35);
}

// A wall that is drawn into a grid goes through its cells somewhere: whatever its offset, looking at it from
// one side must not move the robot to that side, on average.
TEST(BeamModel, ALaserThatLooksOneWayIsNotPushedBack) {
  constexpr double kCell = 0.1, kRange = 2.0;
  double pushed = 0.0;
  for (int offset = 0; offset < 10; ++offset) {
    const double wall = 3.0 + kCell * (offset + 0.5) / 10.0;
    GridGeometry geometry{60, 60, kCell, {0.0, 0.0, 0.0}};
    std::vector<OccupancyGrid::Cell> cells(geometry.size(), 0);
    for (int row = 0; row < 60; ++row) cells[static_cast<std::size_t>(row) * 60 + 30] = 100;
    const BeamModel model(std::make_shared<const RayMarcher>(OccupancyGrid(geometry, std::move(cells)), 20.0),
                          {}, {}, {});
    LaserScan scan{{}, -0.3, 0.1, 0.05, 20.0, {}};
    for (int k = 0; k < 7; ++k)
      scan.ranges_m.push_back(static_cast<float>(kRange / std::cos(-0.3 + 0.1 * k)));
    double best = -1e9, best_x = 0.0;
    for (double x = wall - kRange - 0.2; x < wall - kRange + 0.2; x += 0.001) {
      const double here = score(model, scan, {x, 3.03, 0.0});
      if (here > best) best = here, best_x = x;
    }
    pushed += (best_x - (wall - kRange)) / 10.0;
  }
  EXPECT_NEAR(pushed, 0.0, 0.005);
}

TEST(BeamModel, ManyBeamsDoNotUnderflow) {
  BeamModelOptions options;
  options.max_beams = 0;
  options.effective_beams = 1e5;
  options.z_rand = 1e-6;
  const BeamModel model(room(), {}, {}, options);
  const LaserScan scan = test::scan_of(test::mini_room(), {2.0, 1.2, 0.4}, 1080);
  const double here = score(model, scan, {2.0, 1.2, 0.4});
  const double beside = score(model, scan, {2.4, 1.2, 0.4});
  const double opposite = score(model, scan, {6.2, 1.5, 3.1});
  EXPECT_GT(here, beside + 100.0);
  EXPECT_LT(opposite, -1000.0);
  EXPECT_TRUE(std::isfinite(opposite));
}

TEST(BeamModel, ABeamWithoutReturnSpeaksAgainstANearWall) {
  const BeamModel model(room(), {}, {}, {});
  LaserScan scan{Time{}, 0.0, 0.1, 0.1, 3.0, {3.0f}};
  const double open = score(model, scan, {1.0, 2.5, 0.0}), wall = score(model, scan, {6.9, 1.0, 0.0});
  EXPECT_GT(open, wall + 2.0);
  scan.ranges_m = {std::numeric_limits<float>::infinity()};
  EXPECT_EQ(score(model, scan, {1.0, 2.5, 0.0}), open);
  scan.ranges_m = {0.0f};  // says nothing
  EXPECT_EQ(score(model, scan, {1.0, 1.0, 0.0}), 0.0);
}

TEST(BeamModel, ExplainsWhatTheMapPredicts) {
  const BeamModel model(room(), {}, {}, {});
  const Pose2 truth{2.0, 1.2, 0.4};
  LaserScan scan = test::scan_of(test::mini_room(), truth, 90);
  EXPECT_EQ(model.explained_share(scan, truth), 1.0);
  EXPECT_LT(model.explained_share(scan, truth * Pose2{0.8, 0.5, 1.0}), 0.5);
  scan.range_max_m = 3.0;
  EXPECT_EQ(model.explained_share(scan, truth), 1.0);
  scan.ranges_m.clear();
  EXPECT_EQ(model.explained_share(scan, truth), 0.0);
}

TEST(SelectReadings, KeepsReturnsAndNoReturnsAndDropsWhatSaysNothing) {
  const float inf = std::numeric_limits<float>::infinity();
  const LaserScan scan{Time{}, 0.0, 0.5,
                       0.1,    5.0, {0.0f, std::nanf(""), 0.05f, -1.0f, 2.0f, 5.0f, inf, 4.9f}};
  const auto readings = select_readings(scan, {}, 0);
  ASSERT_EQ(readings.size(), 4U);
  EXPECT_EQ(readings[0].bearing_rad, 2.0);
  EXPECT_TRUE(readings[0].is_return);
  EXPECT_FALSE(readings[1].is_return);
  EXPECT_FALSE(readings[2].is_return);
  EXPECT_EQ(readings[2].range_m, 5.0);
  EXPECT_TRUE(readings[3].is_return);
  EXPECT_EQ(select_readings(scan, {.max_range_m = 1.0}, 0)[0].is_return, false);
  EXPECT_EQ(select_readings(scan, {}, 2).size(), 2U);
}

}  // namespace
}  // namespace cairn
