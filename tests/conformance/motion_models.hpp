#pragma once

#include "cairn/core/angle.hpp"
#include "cairn/models/motion/differential_drive.hpp"
#include "cairn/models/motion/random_walk.hpp"
#include "cairn/models/motion/surface_random_walk.hpp"
#include "mini_meshes.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace cairn::test {

/// A motion model whose control is the odometry's motion, `T_before_after`.
struct MotionModelCase {
  std::string name;
  std::shared_ptr<const MotionModel<Pose2, Pose2>> model;
  bool is_silent_at_rest;  ///< without motion nothing changes
  /// Of what it computes, as a share of the step: 1e-12 for double precision. Headings: a hundredth of it,
  /// rad.
  double precision;
};

/// Every motion model of odometry: one line each.
inline const std::vector<MotionModelCase> kMotionModels = {
    {"DifferentialDrive", std::make_shared<const DifferentialDrive>(DifferentialDriveOptions{}), true, 1e-6},
    {"DifferentialDriveWithLeastNoise",
     std::make_shared<const DifferentialDrive>(
         DifferentialDriveOptions{.sigma_min_m = 0.01, .sigma_min_rad = 0.01}),
     false, 1e-6},
};

/// What the laws need to know of a motion model that is driven by nothing but the time that passes: one type
/// each.
struct PoseWalk {
  using State = Pose2;
  State start{1.0, 2.0, 3.1};

  void propagate(double seconds, std::span<State> states, const RandomStream& random) const {
    RandomWalk({0.3, 0.2}, seconds).propagate({9.0, 9.0, 9.0}, states, random);
  }
  static bool is_valid(const State& p) { return is_finite(p) && p.theta >= -kPi && p.theta < kPi; }
  static double squared_distance(const State& a, const State& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
  }
};

/// On a rectangle, so that distances are those of the plane.
struct SurfaceWalk {
  using State = SurfacePoint;
  std::shared_ptr<const TriangleMesh> mesh = std::make_shared<const TriangleMesh>(flat_rectangle());
  State start{5, {0.4, 0.3, 0.3}};

  void propagate(double seconds, std::span<State> states, const RandomStream& random) const {
    SurfaceRandomWalk(mesh, 0.03).propagate(seconds, states, random);
  }
  bool is_valid(const State& p) const {
    double sum = 0.0;
    for (const double weight : p.weights) {
      if (!(weight >= 0.0)) return false;
      sum += weight;
    }
    return p.face < mesh->size() && std::abs(sum - 1.0) < 1e-9;
  }
  double squared_distance(const State& a, const State& b) const {
    return (mesh->position(a) - mesh->position(b)).squaredNorm();
  }
};

}  // namespace cairn::test
