#pragma once

#include "cairn/core/options.hpp"
#include "cairn/models/search/local_posterior.hpp"
#include "cairn/models/search/pose_search.hpp"

#include <optional>
#include <span>
#include <vector>

namespace cairn {

struct OneShotOptions {
  int most_poses = 10;            ///< distinct poses
  double least_weight = 1e-4;     ///< poses below this share of the best one's likelihood are left out
  double effective_beams = 20.0;  ///< the points count as this many independent beams
  double separation_m = 1.0;      ///< see PoseSearchQuery
  double separation_rad = 0.35;
  double millions_of_points = 200.0;  ///< budget: end points that may be looked up
  std::optional<MapRegion> region = {};

  void visit(OptionVisitor& visitor);
};

/// A place where a robot may be.
struct LocatedPose {
  Pose2 T_map_base;                                      ///< mean of the mode
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the mode: (x, y, theta), m, rad
  double weight = 0.0;                                   ///< share of all poses found; sums to 1
  double log_likelihood = 0.0;  ///< of the best pose of the mode, points scaled to effective_beams
};

struct OneShotResult {
  std::vector<LocatedPose> poses;  ///< heaviest first
  PoseSearchResult search;         ///< the lattice poses behind them, and whether they are proven the best
};

/// Where a robot may be that saw these end points, without any prior but the map: the best poses of all by
/// branch and bound (pose_search.hpp), each with its local posterior (local_posterior.hpp). A pose's weight
/// is the integral of the likelihood around it; a wide mode is more probable than a narrow one of the same
/// height.
/// @param points in the robot's base frame, of one scan or of several joined by odometry
OneShotResult locate(const PoseSearch& search, std::span<const Point2> points, const OneShotOptions& options);

}  // namespace cairn
