#pragma once

#include "cairn/models/motion/differential_drive.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn::test {

/// A motion model whose control is the odometry's motion, `T_before_after`.
struct MotionModelCase {
  std::string name;
  std::shared_ptr<const MotionModel<Pose2, Pose2>> model;
  bool is_silent_at_rest;  ///< without motion nothing changes
};

/// Every motion model of odometry: one line each.
inline const std::vector<MotionModelCase> kMotionModels = {
    {"DifferentialDrive", std::make_shared<const DifferentialDrive>(DifferentialDriveOptions{}), true},
    {"DifferentialDriveWithLeastNoise",
     std::make_shared<const DifferentialDrive>(
         DifferentialDriveOptions{.sigma_min_m = 0.01, .sigma_min_rad = 0.01}),
     false},
};

}  // namespace cairn::test
