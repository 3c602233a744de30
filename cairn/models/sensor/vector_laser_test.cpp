#include "cairn/models/sensor/vector_laser.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/maps/ray_casting.hpp"
#include "cairn/models/sensor/v_amcl.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Pose2 kTBaseSensor{0.2, -0.1, 0.3};

std::shared_ptr<const VectorMap> room() {
  return std::make_shared<const VectorMap>(std::vector<Wall>{
      {{0, 0}, {7, 0}}, {{7, 0}, {8, 5}}, {{8, 5}, {0, 5}}, {{0, 5}, {0, 0}}, {{3, 1.5}, {4, 2.5}}});
}

// An exact scan from `T_map_base`, its beams clockwise if the increment is negative.
LaserScan scan_at(const WallGrid& walls, const Pose2& T_map_base, int beams, double sign = 1.0) {
  LaserScan scan;
  scan.angle_min_rad = -sign * kPi;
  scan.angle_increment_rad = sign * kTwoPi / beams;
  scan.range_max_m = 30.0;
  const Pose2 sensor = T_map_base * kTBaseSensor;
  for (int i = 0; i < beams; ++i) {
    const double angle = sensor.theta + scan.angle_min_rad + i * scan.angle_increment_rad;
    const RayHit hit = cast_ray(walls, {sensor.x, sensor.y}, {std::cos(angle), std::sin(angle)});
    scan.ranges_m.push_back(static_cast<float>(hit.range_m));
  }
  return scan;
}

double score(const LaserModel& model, const LaserScan& scan, const Pose2& pose) {
  double out = std::nan("");
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

Eigen::Vector3d gradient(const BoundUpdate<Pose2>& z, const Pose2& pose) {
  Eigen::Vector3d out;
  z.gradient(std::span(&pose, 1), std::span(&out, 1));
  return out;
}

Eigen::Vector3d numeric_gradient(const LaserModel& model, const LaserScan& scan, const Pose2& p) {
  constexpr double kStep = 1e-6;
  const auto slope = [&](const Pose2& a, const Pose2& b) {
    return (score(model, scan, b) - score(model, scan, a)) / (2 * kStep);
  };
  return {slope({p.x - kStep, p.y, p.theta}, {p.x + kStep, p.y, p.theta}),
          slope({p.x, p.y - kStep, p.theta}, {p.x, p.y + kStep, p.theta}),
          slope({p.x, p.y, p.theta - kStep}, {p.x, p.y, p.theta + kStep})};
}

class VectorLaserTest : public ::testing::Test {
 protected:
  const std::shared_ptr<const WallGrid> walls_ = std::make_shared<const WallGrid>(room());
  const Pose2 truth_{2.0, 3.5, 0.7};
  const VectorLaserOptions options_ = [] {
    VectorLaserOptions o;
    o.obstacle_m = o.short_hit_m = 0.8;
    o.max_beams = 0;
    return o;
  }();
  const VectorLaser model_{walls_, kTBaseSensor, {}, options_};
};

TEST_F(VectorLaserTest, AnExactScanScoresItsMaximum) {
  for (const double sign : {1.0, -1.0}) {
    const LaserScan scan = scan_at(*walls_, truth_, 180, sign);
    EXPECT_NEAR(score(model_, scan, truth_), 0.0, 1e-6);  // ranges are floats
    EXPECT_EQ(model_.explained_share(scan, truth_), 1.0);
    EXPECT_LT(gradient(model_.bind(scan), truth_).norm(), 0.1);
    EXPECT_LT(score(model_, scan, {2.05, 3.5, 0.7}), -1.0);
  }
}

// By hand: the likelihood of two beams that end 0.1 m before and 0.05 m behind their walls, and of one
// without.
TEST_F(VectorLaserTest, FollowsTheFormula) {
  VectorLaserOptions o = options_;
  o.sigma_m = 0.05, o.obstacle_m = 0.2, o.short_hit_m = 0.3, o.out_of_range_m = 0.25;
  const auto wall = std::make_shared<const WallGrid>(
      std::make_shared<const VectorMap>(std::vector<Wall>{{{2, -1}, {2, 5}}, {{-1, 3}, {5, 3}}}));
  const VectorLaser model(wall, {}, {}, o);
  // Looks right along +x (wall at 2), left along +y (wall at 3), and back along -x (nothing).
  LaserScan scan;
  scan.angle_increment_rad = kPi / 2;
  scan.range_max_m = 30.0;
  scan.ranges_m = {1.9f, 3.05f, 4.0f};
  const auto hit = [](double r, double c) {
    return std::log(std::exp(-r * r / 0.005) + std::exp(-c * c / 0.005));
  };
  EXPECT_NEAR(score(model, scan, {0, 0, 0}), hit(0.1, 0.2) + hit(0.05, 0.3) - 0.25 * 0.25 / 0.005, 1e-5);
  EXPECT_NEAR(model.explained_share(scan, {0, 0, 0}), 2.0 / 3.0, 1e-12);
}

TEST_F(VectorLaserTest, TheGradientIsThatOfTheLikelihood) {
  const LaserScan scan = scan_at(*walls_, truth_, 90);
  // Small offsets and a wide cap: all points are gated but those next to corners, whose share is small.
  for (const Pose2& p : {Pose2{2.01, 3.5, 0.7}, Pose2{2.0, 3.48, 0.7}, Pose2{2.0, 3.5, 0.704}}) {
    const Eigen::Vector3d exact = gradient(model_.bind(scan), p), numeric = numeric_gradient(model_, scan, p);
    EXPECT_LT((exact - numeric).norm(), 0.15 * numeric.norm())
        << exact.transpose() << " / " << numeric.transpose();
  }
}

TEST_F(VectorLaserTest, TheGradientLeavesOutWhatDoesNotFit) {
  // A box stands in the room: its points are far off the wall behind it, or run across it.
  LaserScan scan = scan_at(*walls_, truth_, 360);
  for (std::size_t i = 40; i < 80; ++i) scan.ranges_m[i] = 0.6f;
  const Pose2 p{2.02, 3.5, 0.7};
  VectorLaserOptions narrow = options_;
  narrow.gate_m = 0.1;
  const Eigen::Vector3d with_gate = gradient(VectorLaser(walls_, kTBaseSensor, {}, narrow).bind(scan), p);
  const Eigen::Vector3d clean =
      gradient(VectorLaser(walls_, kTBaseSensor, {}, narrow).bind(scan_at(*walls_, truth_, 360)), p);
  EXPECT_LT((with_gate - clean).norm(), 0.25 * clean.norm());
  narrow.gate_rad = 0.0;  // no point of a scan of floats runs exactly along its wall
  EXPECT_LT(gradient(VectorLaser(walls_, kTBaseSensor, {}, narrow).bind(scan), p).norm(), 0.2 * clean.norm());
}

TEST_F(VectorLaserTest, AFewStepsUphillFindThePose) {
  const LaserScan scan = scan_at(*walls_, truth_, 180);
  const BoundUpdate<Pose2> z = model_.bind(scan);
  Pose2 p{2.08, 3.42, 0.73};
  const double before = score(model_, scan, p);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d g = gradient(z, p);
    p = {p.x + 1e-5 * g.x(), p.y + 1e-5 * g.y(), p.theta + 1e-6 * g.z()};
  }
  EXPECT_GT(score(model_, scan, p), before + 1.0);
  EXPECT_LT(std::hypot(p.x - truth_.x, p.y - truth_.y), 0.05);
}

TEST(VectorAmclTest, IsExactAndItsGradientToo) {
  const WallGrid grid(room());
  const auto walls = std::make_shared<const WallDistance>(room(), 2.0);
  LikelihoodFieldOptions options;
  options.max_beams = 0;
  const VectorAmcl model(walls, kTBaseSensor, {}, options);
  const Pose2 truth{2.0, 3.5, 0.7};
  const LaserScan scan = scan_at(grid, truth, 90);
  EXPECT_NEAR(score(model, scan, truth), options.effective_beams * std::log(options.z_hit + options.z_rand),
              1e-6);
  EXPECT_EQ(model.explained_share(scan, truth), 1.0);
  EXPECT_LT(score(model, scan, {2.1, 3.5, 0.7}), score(model, scan, truth) - 1.0);
  for (const Pose2& p : {Pose2{2.03, 3.45, 0.72}, Pose2{2.2, 3.1, 0.4}, Pose2{50, 50, 0}}) {
    const Eigen::Vector3d exact = gradient(model.bind(scan), p), numeric = numeric_gradient(model, scan, p);
    EXPECT_LT((exact - numeric).norm(), 1e-4 * (1.0 + numeric.norm()));
  }
}

}  // namespace
}  // namespace cairn
