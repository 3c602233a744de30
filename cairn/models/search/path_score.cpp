#include "cairn/models/search/path_score.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr int kHalvings = 2;
constexpr int kMostMoves = 8;  // per width of step

bool within_reach(const Pose2& pose, const Pose2& from, const PathFitOptions& o) {
  return distance(pose, from) <= o.reach_m &&
         std::abs(normalize_angle(pose.theta - from.theta)) <= o.reach_rad;
}

std::array<Pose2, 6> neighbours(const Pose2& p, double step_m, double step_rad) {
  return {{{p.x + step_m, p.y, p.theta},
           {p.x - step_m, p.y, p.theta},
           {p.x, p.y + step_m, p.theta},
           {p.x, p.y - step_m, p.theta},
           {p.x, p.y, normalize_angle(p.theta + step_rad)},
           {p.x, p.y, normalize_angle(p.theta - step_rad)}}};
}

// Climbs to the best pose around `pose`; returns its log-likelihood.
double fit(const PoseSearch& search, std::span<const Point2> points, const PathFitOptions& o, Pose2& pose) {
  const Pose2 from = pose;
  double best = search.log_likelihood(points, pose);
  double step_m = o.step_m, step_rad = o.step_rad;
  for (int halving = 0; halving <= kHalvings; ++halving, step_m *= 0.5, step_rad *= 0.5) {
    bool moved = true;
    for (int moves = 0; moved && moves < kMostMoves; ++moves) {
      moved = false;
      for (const Pose2& next : neighbours(pose, step_m, step_rad)) {
        if (!within_reach(next, from, o)) continue;
        const double value = search.log_likelihood(points, next);
        if (value <= best) continue;
        best = value;
        pose = next;
        moved = true;
      }
    }
  }
  return best;
}

}  // namespace

PathScore score_path(const PoseSearch& search, std::span<const PathLook> path, const Pose2& T_map_now,
                     const PathFitOptions& options) {
  PathScore score{T_map_now, std::vector<Pose2>(path.size()), 0.0};
  Pose2 pose = T_map_now;
  for (std::size_t i = path.size(); i-- > 0;) {
    if (i + 1 < path.size()) pose = pose * between(path[i + 1].T_now_then, path[i].T_now_then);
    if (!path[i].points.empty())
      score.log_likelihood +=
          fit(search, path[i].points, options, pose) / static_cast<double>(path[i].points.size());
    score.T_map_then[i] = pose;
  }
  if (!path.empty()) score.T_map_now = score.T_map_then.back() * inverse(path.back().T_now_then);
  return score;
}

}  // namespace cairn
