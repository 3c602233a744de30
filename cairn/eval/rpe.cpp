#include "cairn/eval/rpe.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::vector<double> path_lengths(const Trajectory& trajectory) {
  std::vector<double> lengths(trajectory.size(), 0.0);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    lengths[i] = lengths[i - 1] + distance(trajectory[i - 1].pose, trajectory[i].pose);
  }
  return lengths;
}

void require_positive(bool positive, const char* key) {
  if (!positive) throw ConfigurationError(key, "is not positive", "give a length greater than 0");
}

}  // namespace

Rpe relative_pose_error(const Trajectory& estimate, std::span<const Relation> relations) {
  Rpe rpe;
  for (const Relation& relation : relations) {
    const auto from = pose_at(estimate, relation.from);
    const auto to = pose_at(estimate, relation.to);
    if (!from || !to) {
      ++rpe.outside;
      continue;
    }
    const Pose2 error = between(relation.T_from_to, between(*from, *to));
    const double translation = std::hypot(error.x, error.y);
    ++rpe.pairs;
    rpe.translation_rms_m += translation * translation;
    rpe.rotation_rms_rad += error.theta * error.theta;
    rpe.translation_max_m = std::max(rpe.translation_max_m, translation);
    rpe.rotation_max_rad = std::max(rpe.rotation_max_rad, std::abs(error.theta));
  }
  const double n = std::max(1.0, static_cast<double>(rpe.pairs));
  rpe.translation_rms_m = std::sqrt(rpe.translation_rms_m / n);
  rpe.rotation_rms_rad = std::sqrt(rpe.rotation_rms_rad / n);
  return rpe;
}

std::vector<Relation> relations_over_time(const Trajectory& reference, Duration delta) {
  require_positive(delta > Duration::zero(), "rpe_delta_s");
  std::vector<Relation> relations;
  for (const auto& [stamp, pose] : reference) {
    if (const auto later = pose_at(reference, stamp + delta)) {
      relations.push_back({stamp, stamp + delta, between(pose, *later)});
    }
  }
  return relations;
}

std::vector<Relation> relations_over_distance(const Trajectory& reference, double delta_m) {
  require_positive(delta_m > 0.0, "rpe_delta_m");
  const std::vector<double> lengths = path_lengths(reference);
  std::vector<Relation> relations;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const auto found = std::lower_bound(lengths.begin(), lengths.end(), lengths[i] + delta_m);
    if (found == lengths.end()) break;
    const StampedPose& to = reference[static_cast<std::size_t>(found - lengths.begin())];
    relations.push_back({reference[i].stamp, to.stamp, between(reference[i].pose, to.pose)});
  }
  return relations;
}

}  // namespace cairn
