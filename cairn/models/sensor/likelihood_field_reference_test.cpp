#include "cairn/models/sensor/likelihood_field_reference.hpp"

#include "cairn/core/angle.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

LikelihoodFieldOptions options(double sigma_hit_m = 0.5, double max_distance_m = 2.0) {
  LikelihoodFieldOptions o;
  o.z_hit = 0.8;
  o.z_rand = 0.2;
  o.sigma_hit_m = sigma_hit_m;
  o.max_distance_m = max_distance_m;
  return o;
}

LikelihoodFieldReference model_of(const OccupancyGrid& map, const LikelihoodFieldOptions& o,
                                  const Pose2& T_base_sensor = {}) {
  return {std::make_shared<const DistanceField>(map, o.max_distance_m), T_base_sensor, {}, o};
}

// Beams of one sensor, the first straight ahead, the others 90 degrees apart.
LaserScan cross(const std::vector<float>& ranges) {
  LaserScan scan;
  scan.angle_increment_rad = kPi / 2.0;
  scan.range_min_m = 0.01;
  scan.range_max_m = 50.0;
  scan.ranges_m = ranges;
  return scan;
}

double score(const LikelihoodFieldReference& model, const LaserScan& scan, const Pose2& pose) {
  double out = std::nan("");
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

// log p of an end point at a distance from the wall, for options().
double log_p(double distance_m, double sigma = 0.5) {
  return std::log(0.8 * std::exp(-distance_m * distance_m / (2.0 * sigma * sigma)) + 0.2);
}

const OccupancyGrid kTiny = test::draw_grid({"    #",  //
                                             "     ",  //
                                             "#    "});

TEST(LikelihoodFieldReference, AMiniatureByHand) {
  const LikelihoodFieldReference model = model_of(kTiny, options());
  const Pose2 pose{1.5, 1.5, 0.0};                                   // in the middle row, second column
  EXPECT_NEAR(score(model, cross({1.0f}), pose), log_p(2.0), 1e-6);  // (2, 1): cut at 2 m
  EXPECT_NEAR(score(model, cross({2.0f}), pose), log_p(std::sqrt(2.0)), 1e-6);  // (3, 1)
  EXPECT_NEAR(score(model, cross({3.0f}), pose), log_p(1.0), 1e-6);             // (4, 1), below the wall
  EXPECT_NEAR(score(model, cross({3.0f, 1.0f, 1.0f}), pose), log_p(1.0) + log_p(2.0) + log_p(1.0), 1e-6);
  EXPECT_NEAR(score(model, cross({1.0f}), {0.5, 1.5, -kPi / 2.0}), log_p(0.0), 1e-6);  // into the wall (0, 0)
}

TEST(LikelihoodFieldReference, OffTheMapIsFarFromAnyWall) {
  const LikelihoodFieldReference model = model_of(kTiny, options());
  for (const Pose2& pose : {Pose2{1.5, 1.5, kPi}, Pose2{1.5, 1.5, kPi / 2.0}, Pose2{-20, 1, 0}}) {
    EXPECT_NEAR(score(model, cross({4.0f}), pose), log_p(2.0), 1e-6);
  }
  // One cell off the map, beside the wall (4, 2): not the wall's own value.
  EXPECT_NEAR(score(model, cross({4.0f}), {1.5, 2.5, 0.0}), log_p(2.0), 1e-6);
}

TEST(LikelihoodFieldReference, IsFiniteEverywhere) {
  const LikelihoodFieldReference model = model_of(kTiny, options());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  const std::vector<Pose2> poses = {
      {1e6, -1e6, 1}, {1e12, 1e12, 3},   {-1e18, 1e-300, -3},    {1e300, -1e300, 1},
      {-100, 0, 1e9}, {kInfinity, 0, 0}, {0, -kInfinity, 0},     {nan, 0, 0},
      {0, 0, nan},    {0, 0, kInfinity}, {1.7e308, 1.7e308, 0.7}};
  for (const Pose2& pose : poses) {
    EXPECT_NEAR(score(model, cross({1.0f, 2.0f, 3.0f, 4.0f}), pose), 4.0 * log_p(2.0), 1e-5)
        << pose.x << ' ' << pose.y << ' ' << pose.theta;
    const double share = model.explained_share(cross({1.0f}), pose);
    EXPECT_EQ(share, 0.0);
  }
}

std::vector<Pose2> random_poses(std::size_t n) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto u = random.uniform4(i);
    poses.push_back({8.0 * u[0], 5.0 * u[1], normalize_angle(kTwoPi * u[2])});
  }
  return poses;
}

TEST(LikelihoodFieldReference, ABatchIsOneByOne) {
  const OccupancyGrid room = test::mini_room();
  const LikelihoodFieldReference model = model_of(room, {});
  const LaserScan scan = test::scan_of(room, {2, 1.2, 0.4}, 90);
  const auto poses = random_poses(300);
  std::vector<double> batch(poses.size());
  model.log_likelihood(scan, poses, batch);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(score(model, scan, poses[i]), batch[i]);
  EXPECT_GT(*std::max_element(batch.begin(), batch.end()),
            *std::min_element(batch.begin(), batch.end()) + 10);
}

TEST(LikelihoodFieldReference, MovesWithMapPoseAndSensor) {
  const Pose2 T_map_grid{0.3, -0.2, 0.1}, T_base_sensor{0.15, -0.05, 0.3}, T_new_map{-40.0, 7.0, 2.2};
  const Pose2 T_new_base{0.2, 0.1, -0.7};  // another choice of the robot's frame
  const OccupancyGrid room = test::mini_room(T_map_grid);
  const LikelihoodFieldReference model = model_of(room, {}, T_base_sensor);
  const LikelihoodFieldReference moved =
      model_of(test::mini_room(T_new_map * T_map_grid), {}, T_new_base * T_base_sensor);
  const LaserScan scan = test::scan_of(room, Pose2{2, 1.2, 0.4} * T_base_sensor, 90);
  for (const Pose2& pose : random_poses(100)) {
    const Pose2 moved_pose = T_new_map * pose * inverse(T_new_base);
    EXPECT_NEAR(score(moved, scan, moved_pose), score(model, scan, pose), 1e-9);
    EXPECT_EQ(moved.explained_share(scan, moved_pose), model.explained_share(scan, pose));
  }
}

TEST(LikelihoodFieldReference, TheTruthScoresAbovePerturbedPoses) {
  const Pose2 T_base_sensor{0.15, -0.05, 0.3};
  const OccupancyGrid room = test::mini_room();
  const LikelihoodFieldReference model = model_of(room, {}, T_base_sensor);
  for (const Pose2& truth :
       {Pose2{2, 1.2, 0.4}, Pose2{6.5, 1.0, 3.1}, Pose2{4.5, 4.2, -1.5}, Pose2{0.7, 3.5, -3.1}}) {
    const LaserScan scan = test::scan_of(room, truth * T_base_sensor, 180);
    const double best = score(model, scan, truth);
    for (const double s : {-1.0, 1.0}) {
      for (const Pose2& step : {Pose2{0.15, 0, 0}, Pose2{0, 0.15, 0}, Pose2{0, 0, 0.1}, Pose2{1, 0.5, 0}}) {
        const Pose2 perturbed = truth * Pose2{s * step.x, s * step.y, s * step.theta};
        EXPECT_GT(best, score(model, scan, perturbed) + 1.0);
      }
    }
    EXPECT_GT(model.explained_share(scan, truth), 0.99);
  }
}

TEST(LikelihoodFieldReference, AScanCountsForAtMostSoManyBeams) {
  const Pose2 pose{1.5, 1.5, 0.0};
  const LaserScan scan = cross({3.0f, 1.0f, 1.0f, 0.5f});
  LikelihoodFieldOptions o = options();
  o.effective_beams = 100.0;
  const double whole = score(model_of(kTiny, o), scan, pose);
  o.effective_beams = 4.0;
  EXPECT_DOUBLE_EQ(score(model_of(kTiny, o), scan, pose), whole);
  o.effective_beams = 1.0;
  EXPECT_DOUBLE_EQ(score(model_of(kTiny, o), scan, pose), whole / 4.0);
  // What counts is the number of beams with a return.
  o.effective_beams = 2.0;
  EXPECT_DOUBLE_EQ(score(model_of(kTiny, o), cross({3.0f, 0.0f, 0.0f, 0.0f}), pose),
                   score(model_of(kTiny, options()), cross({3.0f}), pose));
}

TEST(LikelihoodFieldReference, EvaluatesAtMostMaxBeams) {
  const Pose2 pose{1.5, 1.5, 0.0};
  LikelihoodFieldOptions o = options();
  o.max_beams = 1;  // the middle one of three
  EXPECT_DOUBLE_EQ(score(model_of(kTiny, o), cross({3.0f, 1.0f, 2.0f}), pose),
                   score(model_of(kTiny, o), cross({0.0f, 1.0f, 0.0f}), pose));
}

TEST(LikelihoodFieldReference, AScanWithoutAValidBeamSaysNothing) {
  const LikelihoodFieldReference model = model_of(kTiny, options());
  for (const LaserScan& scan : {cross({}), cross({0.0f, 0.0f}), cross({std::nanf("")})}) {
    for (const Pose2& pose : {Pose2{1.5, 1.5, 0}, Pose2{-100, 0, 0}})
      EXPECT_EQ(score(model, scan, pose), 0.0);
    EXPECT_EQ(model.explained_share(scan, {1.5, 1.5, 0}), 0.0);
  }
}

TEST(LikelihoodFieldReference, TheOrderOfTheBeamsDoesNotMatter) {
  const OccupancyGrid room = test::mini_room();
  LikelihoodFieldOptions all;
  all.max_beams = 0;
  const LikelihoodFieldReference model = model_of(room, all);
  const LaserScan scan = test::scan_of(room, {2, 1.2, 0.4}, 90);
  LaserScan reversed = scan;
  std::reverse(reversed.ranges_m.begin(), reversed.ranges_m.end());
  reversed.angle_min_rad = scan.angle_min_rad + 89.0 * scan.angle_increment_rad;
  reversed.angle_increment_rad = -scan.angle_increment_rad;
  for (const Pose2& pose : random_poses(50))
    EXPECT_NEAR(score(model, reversed, pose), score(model, scan, pose), 1e-9);
}

TEST(LikelihoodFieldReference, ExplainedShareByHand) {
  const LikelihoodFieldReference model = model_of(kTiny, options(0.4));  // within 1.2 m of a wall
  const Pose2 pose{1.5, 1.5, 0.0};
  EXPECT_EQ(model.explained_share(cross({3.0f}), pose), 1.0);              // 1 m
  EXPECT_EQ(model.explained_share(cross({2.0f}), pose), 0.0);              // sqrt(2) m
  EXPECT_EQ(model.explained_share(cross({3.0f, 9.0f}), pose), 0.5);        // the second off the map
  EXPECT_EQ(model.explained_share(cross({3.0f, 9.0f, 0.0f}), pose), 0.5);  // no return does not count
}

TEST(LikelihoodFieldReference, TheUpdateOutlivesItsModelAndScan) {
  BoundUpdate<Pose2> update;
  double before = 0.0;
  const Pose2 pose{1.5, 1.5, 0.0};
  {
    const LikelihoodFieldReference model = model_of(kTiny, options());
    LaserScan scan = cross({3.0f});
    scan.stamp = Time(Duration(42));
    update = model.bind(scan);
    before = score(model, scan, pose);
  }
  double after = 0.0;
  update.log_likelihood(std::span(&pose, 1), std::span(&after, 1));
  EXPECT_EQ(after, before);
  EXPECT_EQ(update.stamp, Time(Duration(42)));
}

}  // namespace
}  // namespace cairn
