#include "cairn/models/sensor/likelihood_field.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/maps/grid_ray_caster.hpp"
#include "cairn/models/sensor/likelihood_field_reference.hpp"
#include "mini_maps.hpp"
#include "simd_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Everything that the formula says is tested on the reference; here: that the fast model says the same.

std::shared_ptr<const DistanceField> field_of(const OccupancyGrid& map, double max_distance_m = 2.0) {
  return std::make_shared<const DistanceField>(map, max_distance_m);
}

// A scan of the full circle.
LaserScan scan_of(const OccupancyGrid& map, const Pose2& T_map_sensor, int beams) {
  LaserScan scan{Time{}, -kPi, kTwoPi / beams, 0.01, 20.0, {}};
  for (int i = 0; i < beams; ++i) {
    const Pose2 ray{T_map_sensor.x, T_map_sensor.y,
                    T_map_sensor.theta + scan.angle_min_rad + i * scan.angle_increment_rad};
    scan.ranges_m.push_back(static_cast<float>(cast_ray(map, ray, 20.0)));
  }
  return scan;
}

double score(const LaserModel& model, const LaserScan& scan, const Pose2& pose) {
  double out = std::nan("");
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

std::vector<double> scores(const LaserModel& model, const LaserScan& scan, const std::vector<Pose2>& poses) {
  std::vector<double> out(poses.size(), std::nan(""));
  model.log_likelihood(scan, poses, out);
  return out;
}

// Half of them near `center` (0.2 m, 0.1 rad), half anywhere in the room and around it.
std::vector<Pose2> poses_around(const Pose2& center, std::size_t n) {
  const RandomStream random(5, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < n / 2; ++i) {
    const auto g = random.normal4(i);
    poses.push_back(center * Pose2{0.2 * g[0], 0.2 * g[1], 0.1 * g[2]});
    const auto u = random.uniform4(i, 1);
    poses.push_back({10.0 * u[0] - 1.0, 7.0 * u[1] - 1.0, kTwoPi * u[2]});
  }
  return poses;
}

struct Errors {
  double mean = 0.0;
  double p99 = 0.0;
};

Errors errors_of(const LikelihoodFieldOptions& options, int beams, const Pose2& T_map_grid) {
  const Pose2 T_base_sensor{0.15, -0.05, 0.3}, truth = T_map_grid * Pose2{2, 1.2, 0.4};
  const OccupancyGrid room = test::mini_room(T_map_grid);
  const LikelihoodField fast(field_of(room), T_base_sensor, {}, options);
  const LikelihoodFieldReference exact(field_of(room), T_base_sensor, {}, options);
  const LaserScan scan = scan_of(room, truth * T_base_sensor, beams);
  const auto poses = poses_around(truth, 600);
  const auto a = scores(fast, scan, poses), b = scores(exact, scan, poses);
  std::vector<double> errors;
  for (std::size_t i = 0; i < a.size(); ++i) errors.push_back(std::abs(a[i] - b[i]));
  std::sort(errors.begin(), errors.end());
  return {std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()),
          errors[errors.size() * 99 / 100]};
}

// Promised in nat: mean 0.05, 99th percentile 0.35. Each beam with its full weight, in a turned grid.
TEST(LikelihoodField, IsCloseToTheReference) {
  LikelihoodFieldOptions o;
  o.max_beams = 0;
  for (const int beams : {60, 360, 1080}) {
    for (const double z_rand : {0.15, 0.01, 1e-6}) {
      o.z_rand = z_rand;
      o.effective_beams = beams;
      const Errors errors = errors_of(o, beams, {40.3, -7.2, 0.6});
      EXPECT_LE(errors.mean, 0.05) << beams << " beams, z_rand " << z_rand;
      EXPECT_LE(errors.p99, 0.35) << beams << " beams, z_rand " << z_rand;
    }
  }
}

TEST(LikelihoodField, AScanOfTwentyEffectiveBeamsIsCloserStill) {
  const Errors errors = errors_of({}, 180, {});
  EXPECT_LE(errors.mean, 0.01);
  EXPECT_LE(errors.p99, 0.05);
}

TEST(LikelihoodField, EveryPathGivesTheSameBits) {
  const OccupancyGrid room = test::mini_room({0.3, -0.2, 0.1});
  for (const double effective_beams : {20.0, 1000.0}) {  // codes of 8 and of 16 bits
    LikelihoodFieldOptions o;
    o.max_beams = 0;
    o.effective_beams = effective_beams;
    const LikelihoodField model(field_of(room), {0.1, 0, 0.2}, {}, o);
    const LaserScan scan = scan_of(room, {2, 1.2, 0.4}, 301);
    const auto poses = poses_around({2, 1.2, 0.4}, 501);
    std::vector<double> expected;
    test::on_every_simd_path([&](SimdPath path) {
      const auto found = scores(model, scan, poses);
      if (expected.empty()) expected = found;
      EXPECT_EQ(found, expected) << name_of(path);
    });
  }
}

// Best and worst cells are exact: a beam into a wall, a beam far from any.
TEST(LikelihoodField, IsExactAtWallsAndFarFromThem) {
  const OccupancyGrid tiny = test::draw_grid({"    #",  //
                                              "     ",  //
                                              "#    "});
  LikelihoodFieldOptions o;
  o.sigma_hit_m = 0.5;
  const LikelihoodField model(field_of(tiny), {}, {}, o);
  const LaserScan ahead{Time{}, 0.0, 0.1, 0.01, 50.0, {1.0f}};
  EXPECT_NEAR(score(model, ahead, {0.5, 1.5, -kPi / 2.0}), o.log_likelihood(0.0), 1e-12);
  EXPECT_NEAR(score(model, ahead, {1.5, 1.5, 0.0}), o.log_likelihood(2.0), 1e-12);
  // One cell off the map, beside the wall (4, 2).
  EXPECT_NEAR(score(model, ahead, {4.5, 2.5, 0.0}), o.log_likelihood(2.0), 1e-12);
}

TEST(LikelihoodField, WhatIsFarOrNotANumberSeesTheBorder) {
  const OccupancyGrid room = test::mini_room({3, 4, 0.5});
  LikelihoodFieldOptions o;
  o.effective_beams = 60;
  const LikelihoodField model(field_of(room), {}, {}, o);
  const LaserScan scan = scan_of(room, room.geometry().T_map_grid * Pose2{2, 1.2, 0.4}, 60);
  const auto beams = static_cast<double>(select_end_points(scan, {}, {}, 0).size());
  const double nowhere = beams * o.log_likelihood(2.0);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  for (const Pose2& pose : {Pose2{1e6, -1e6, 1},
                            {1e12, 1e12, 3},
                            {-1e18, 1e-300, -3},
                            {1e300, -1e300, 1},
                            {kInfinity, 0, 0},
                            {0, -kInfinity, 0},
                            {nan, 0, 0},
                            {0, 0, nan},
                            {0, 0, kInfinity},
                            {1.7e308, 1.7e308, 0.7}}) {
    EXPECT_NEAR(score(model, scan, pose), nowhere, 1e-9) << pose.x << ' ' << pose.y << ' ' << pose.theta;
    EXPECT_EQ(model.explained_share(scan, pose), 0.0);
  }
  EXPECT_TRUE(std::isfinite(score(model, scan, {3, 4, 1e9})));
}

TEST(LikelihoodField, BeamsLongerThanAnyMapEndOffIt) {
  const OccupancyGrid room = test::mini_room();
  const LikelihoodField model(field_of(room), {}, {0.0, 1e30}, {});
  const LaserScan scan{Time{}, 0.0, kPi / 4.0, 0.1, 1e38, std::vector<float>(8, 9e28f)};
  for (const double heading : {0.0, 0.1, kPi / 4.0})
    EXPECT_NEAR(score(model, scan, {4, 3, heading}), 8.0 * LikelihoodFieldOptions{}.log_likelihood(2.0),
                1e-9);
}

// A heading and the same after many turns.
TEST(LikelihoodField, HeadingsMayBeBeyondTheirInterval) {
  const OccupancyGrid room = test::mini_room();
  const LikelihoodField model(field_of(room), {}, {}, {});
  const LaserScan scan = scan_of(room, {2, 1.2, 0.4}, 90);
  EXPECT_NEAR(score(model, scan, {2, 1.2, 0.4 + 50 * kTwoPi}), score(model, scan, {2, 1.2, 0.4}), 0.02);
}

TEST(LikelihoodField, ABatchIsOneByOne) {
  const OccupancyGrid room = test::mini_room();
  const LikelihoodField model(field_of(room), {}, {}, {});
  const LaserScan scan = scan_of(room, {2, 1.2, 0.4}, 90);
  const auto poses = poses_around({2, 1.2, 0.4}, 1300);
  const auto batch = scores(model, scan, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(score(model, scan, poses[i]), batch[i]);
}

TEST(LikelihoodField, AScanWithoutAValidBeamSaysNothing) {
  const LikelihoodField model(field_of(test::mini_room()), {}, {}, {});
  const LaserScan scan{Time{}, 0.0, 0.1, 0.1, 8.0, {0.0f, std::nanf("")}};
  for (const Pose2& pose : {Pose2{1.5, 1.5, 0}, Pose2{-100, 0, 0}}) EXPECT_EQ(score(model, scan, pose), 0.0);
  EXPECT_EQ(model.explained_share(scan, {1.5, 1.5, 0}), 0.0);
}

TEST(LikelihoodField, ExplainsWhatTheReferenceExplains) {
  const OccupancyGrid room = test::mini_room({0.3, -0.2, 0.1});
  const LaserScan scan = scan_of(room, {2, 1.2, 0.4}, 90);
  for (const double sigma_hit_m : {0.01, 0.05, 1.0}) {
    LikelihoodFieldOptions o;
    o.sigma_hit_m = sigma_hit_m;
    const LikelihoodField fast(field_of(room), {0.1, 0, 0.2}, {}, o);
    const LikelihoodFieldReference exact(field_of(room), {0.1, 0, 0.2}, {}, o);
    for (const Pose2& pose : poses_around({2, 1.2, 0.4}, 200))
      EXPECT_EQ(fast.explained_share(scan, pose), exact.explained_share(scan, pose));
  }
}

TEST(LikelihoodField, TheUpdateOutlivesItsModelAndItsField) {
  const OccupancyGrid room = test::mini_room();
  const Pose2 pose{2, 1.2, 0.4};
  BoundUpdate<Pose2> update;
  double before = 0.0;
  {
    const LikelihoodField model(field_of(room), {}, {}, {});
    LaserScan scan = scan_of(room, pose, 90);
    scan.stamp = Time(Duration(42));
    update = model.bind(scan);
    before = score(model, scan, pose);
  }
  double after = 0.0;
  update.log_likelihood(std::span(&pose, 1), std::span(&after, 1));
  EXPECT_EQ(after, before);
  EXPECT_EQ(update.stamp, Time(Duration(42)));
}

// Nothing hits: every cell is alike, and no step divides by zero.
TEST(LikelihoodField, ALikelihoodThatKnowsNoWalls) {
  LikelihoodFieldOptions o;
  o.z_hit = 0.0;
  const OccupancyGrid room = test::mini_room();
  const LikelihoodField model(field_of(room), {}, {}, o);
  const LaserScan scan = scan_of(room, {2, 1.2, 0.4}, 60);
  EXPECT_NEAR(score(model, scan, {2, 1.2, 0.4}), 20.0 * std::log(o.z_rand), 1e-9);
}

}  // namespace
}  // namespace cairn
