#include "cairn/bayes/kalman.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/linearisations.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const Pose2 kTBaseSensor{0.15, -0.05, 0.3};
const Pose2 kTMapGrid{0.313, -0.217, 0.1};
const std::vector<Pose2> kTruths = {{2.0, 1.2, 0.4}, {6.2, 1.5, 3.1}, {4.2, 4.2, -1.5}, {0.7, 3.7, -3.1}};

std::shared_ptr<const ScanMatching> linearisation(const std::string& name, const OccupancyGrid& map,
                                                  const Pose2& T_base_sensor) {
  const MapSet maps(std::make_shared<const OccupancyGrid>(map));
  return make_laser_linearisation(name, {maps, T_base_sensor, BeamLimits{}, LaserModelOptions{}});
}

class LinearisationLaws : public ::testing::TestWithParam<std::string> {
 protected:
  const OccupancyGrid room_ = mini_room(kTMapGrid);
  const std::shared_ptr<const ScanMatching> model_ = linearisation(GetParam(), room_, kTBaseSensor);

  LaserScan scan_at(const Pose2& T_map_base) const { return scan_of(room_, T_map_base * kTBaseSensor, 180); }
};

// Off the truth by 0.15 m and 5 degrees, in one of several directions.
Pose2 perturbed(const Pose2& truth, int k) {
  const double angle = 2.399963 * k, turn = (k % 2 == 0 ? 1.0 : -1.0) * 5.0 * kPi / 180.0;
  return {truth.x + 0.15 * std::cos(angle), truth.y + 0.15 * std::sin(angle),
          normalize_angle(truth.theta + turn)};
}

double turn(const Pose2& a, const Pose2& b) { return std::abs(normalize_angle(a.theta - b.theta)); }

TEST(Linearisation, AModelWithoutOneIsAConfigurationError) {
  const auto names = linearised_laser_models();
  for (const std::string& name : laser_model_names()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    EXPECT_THROW(linearisation(name, mini_room(), {}), ConfigurationError) << name;
  }
  EXPECT_THROW(linearisation("sonar", mini_room(), {}), ConfigurationError);
}

TEST_P(LinearisationLaws, HAgreesWithNumericDifferences) {
  constexpr double kStep = 1e-6;
  const LaserScan scan = scan_at(kTruths[0]);
  const RandomStream random(4, RandomPurpose::kTest, 0);
  std::size_t compared = 0, different = 0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto n = random.normal4(i);
    const Pose2 pose = kTruths[0] * Pose2{0.1 * n[0], 0.1 * n[1], 0.05 * n[2]};
    const Linearised<3> here = model_->linearise(scan, pose);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d d = kStep * Eigen::Vector3d::Unit(k);
      const auto before = model_->linearise(scan, {pose.x - d[0], pose.y - d[1], pose.theta - d[2]});
      const auto after = model_->linearise(scan, {pose.x + d[0], pose.y + d[1], pose.theta + d[2]});
      if (before.size() != here.size() || after.size() != here.size()) continue;  // a point crossed the gate
      for (Eigen::Index row = 0; row < here.size(); ++row, ++compared) {
        const double numeric = (after.z_hat[row] - before.z_hat[row]) / (2.0 * kStep);
        different += std::abs(here.H(row, k) - numeric) > 1e-4 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 8000u);
  EXPECT_LE(different, compared / 500);  // the distance has kinks: between cells, between two walls
}

TEST_P(LinearisationLaws, TheNoiseIsPositiveAndGrowsWithTheDistance) {
  const Linearised<3> z = model_->linearise(scan_at(kTruths[0]), perturbed(kTruths[0], 1));
  ASSERT_GT(z.size(), 50);
  EXPECT_TRUE(z.R.isDiagonal());
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    EXPECT_GT(z.R(i, i), 0.0);
    for (Eigen::Index j = 0; j < z.size(); ++j) EXPECT_EQ(z.z_hat[i] < z.z_hat[j], z.R(i, i) < z.R(j, j));
  }
}

TEST_P(LinearisationLaws, InvariantWhenMapPoseAndSensorMoveTogether) {
  const Pose2 T_new_map{-40.0, 7.0, 2.2}, T_new_base{0.2, 0.1, -0.7};
  const auto other = linearisation(GetParam(), mini_room(T_new_map * kTMapGrid), T_new_base * kTBaseSensor);
  const LaserScan scan = scan_at(kTruths[1]);
  for (int k = 0; k < 20; ++k) {
    const Pose2 pose = perturbed(kTruths[1], k);
    const auto here = model_->linearise(scan, pose);
    const auto there = other->linearise(scan, T_new_map * pose * inverse(T_new_base));
    ASSERT_EQ(here.size(), there.size());
    EXPECT_TRUE(here.z_hat.isApprox(there.z_hat, 1e-6));
    EXPECT_TRUE(here.R.isApprox(there.R, 1e-6));
  }
}

// A Kalman filter that knows the pose to 0.15 m and 5 degrees knows it to 2 cm after a few scans from the
// same place, each linearised at the mean.
TEST_P(LinearisationLaws, AnExtendedKalmanFilterFindsThePose) {
  for (const Pose2& truth : kTruths) {
    const LaserScan scan = scan_at(truth);
    for (int k = 0; k < 8; ++k) {
      const Pose2 start = perturbed(truth, k);
      KalmanFilter<3> filter({start.x, start.y, start.theta},
                             Eigen::Vector3d(0.15 * 0.15, 0.15 * 0.15, 0.09 * 0.09).asDiagonal());
      for (int scans = 0; scans < 15; ++scans) {
        const Linearised<3> z =
            model_->linearise(scan, {filter.mean()[0], filter.mean()[1], filter.mean()[2]});
        const auto used = filter.correct_residual<Eigen::Dynamic>(z.residual(), z.H, z.R);
        ASSERT_TRUE(used.has_value());
        ASSERT_TRUE(std::isfinite(used->log_likelihood));
      }
      const Pose2 found{filter.mean()[0], filter.mean()[1], filter.mean()[2]};
      EXPECT_LT(distance(found, truth), 0.05) << "start " << k;
      EXPECT_LT(turn(found, truth), 0.02) << "start " << k;
    }
  }
}

TEST_P(LinearisationLaws, TheIteratedUpdateFindsThePoseFromOneScan) {
  const GaussianPose wide{{}, Eigen::Vector3d(1.0, 1.0, 0.3).asDiagonal()};
  for (const Pose2& truth : kTruths) {
    const LaserScan scan = scan_at(truth);
    for (int k = 0; k < 8; ++k) {
      const auto found = iterated_update(*model_, scan, {perturbed(truth, k), wide.covariance});
      ASSERT_TRUE(found.has_value());
      EXPECT_LT(distance(found->mean, truth), 0.04) << "start " << k;
      EXPECT_LT(turn(found->mean, truth), 0.02) << "start " << k;
      EXPECT_LT(found->covariance(0, 0), 0.03 * 0.03);
      EXPECT_LT(found->covariance(1, 1), 0.03 * 0.03);
    }
  }
}

TEST_P(LinearisationLaws, ANarrowPriorHolds) {
  const Pose2 start = perturbed(kTruths[0], 3);
  const GaussianPose sure{start, 1e-10 * Eigen::Matrix3d::Identity()};
  const auto found = iterated_update(*model_, scan_at(kTruths[0]), sure);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(distance(found->mean, start), 1e-3);
}

TEST_P(LinearisationLaws, WhatSaysNothingHasNoRows) {
  const LaserScan scan = scan_at(kTruths[0]);
  for (const float range : {0.0f, -1.0f, std::nanf(""), HUGE_VALF}) {
    LaserScan none = scan;
    std::fill(none.ranges_m.begin(), none.ranges_m.end(), range);
    EXPECT_EQ(model_->linearise(none, kTruths[0]).size(), 0);
    EXPECT_FALSE(iterated_update(*model_, none, {kTruths[0], Eigen::Matrix3d::Identity()}));
  }
  LaserScan empty = scan;
  empty.ranges_m.clear();
  EXPECT_EQ(model_->linearise(empty, kTruths[0]).size(), 0);
  for (const double bad : {std::nan(""), HUGE_VAL, 1e300}) {
    for (const Pose2& pose : {Pose2{bad, 1, 1}, Pose2{1, bad, 1}}) {
      EXPECT_EQ(model_->linearise(scan, pose).size(), 0);
    }
    const Linearised<3> turned = model_->linearise(scan, {1, 1, bad});
    EXPECT_TRUE(turned.z_hat.allFinite() && turned.H.allFinite() && turned.R.allFinite());
  }
  EXPECT_FALSE(iterated_update(*model_, scan, {kTruths[0], -Eigen::Matrix3d::Identity()}));
}

INSTANTIATE_TEST_SUITE_P(Conformance, LinearisationLaws, ::testing::ValuesIn(linearised_laser_models()),
                         [](const auto& chosen) { return chosen.param; });

}  // namespace
}  // namespace cairn::test
