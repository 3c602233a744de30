#pragma once

#include "cairn/models/search/pose_search.hpp"

#include <functional>
#include <span>
#include <vector>

namespace cairn {

/// What a robot saw at one pose of its way.
struct PathLook {
  std::vector<Point2> points;  ///< end points in the robot's base frame of then, metres
  Pose2 T_now_then;            ///< that pose seen from the newest one, by odometry
};

/// How far the odometry is trusted from one look to the next.
struct PathFitOptions {
  double step_m = 0.1;     ///< first step of the fit of each look, halved twice
  double step_rad = 0.04;  ///< likewise
  double reach_m = 0.2;    ///< a look moves by at most this against the one after it
  double reach_rad = 0.1;  ///< likewise
};

/// A way that ended at a pose, as the looks say.
struct PathScore {
  Pose2 T_map_now;                ///< fitted to the newest look
  std::vector<Pose2> T_map_then;  ///< of each look, in their order
  double log_likelihood = 0.0;    ///< sum over the looks of their mean over the end points
};

/// How well all looks of a way agree with the map if it ended at `T_map_now`. Goes back from the newest look
/// to the oldest; each is fitted to the map within the reach of the odometry's errors, so that drift over
/// tens of metres does not count against the true pose: a greedy form of the most probable path (Viterbi).
/// @param path the newest last
PathScore score_path(const PoseSearch& search, std::span<const PathLook> path, const Pose2& T_map_now,
                     const PathFitOptions& options = {});

}  // namespace cairn
