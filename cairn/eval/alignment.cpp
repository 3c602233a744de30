#include "cairn/eval/alignment.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <string>

namespace cairn {
namespace {

struct Centroids {
  Point2 reference;
  Point2 estimate;
};

Centroids centroids(std::span<const PosePair> pairs) {
  Centroids c;
  for (const auto& pair : pairs) {
    c.reference = {c.reference.x + pair.reference.x, c.reference.y + pair.reference.y};
    c.estimate = {c.estimate.x + pair.estimate.x, c.estimate.y + pair.estimate.y};
  }
  const auto n = static_cast<double>(pairs.size());
  return {{c.reference.x / n, c.reference.y / n}, {c.estimate.x / n, c.estimate.y / n}};
}

double best_turn(std::span<const PosePair> pairs, const Centroids& c) {
  double dot = 0.0;
  double cross = 0.0;
  for (const auto& [stamp, reference, estimate] : pairs) {
    const double ex = estimate.x - c.estimate.x, ey = estimate.y - c.estimate.y;
    const double rx = reference.x - c.reference.x, ry = reference.y - c.reference.y;
    dot += ex * rx + ey * ry;
    cross += ex * ry - ey * rx;
  }
  return std::atan2(cross, dot);
}

}  // namespace

const char* to_string(Alignment alignment) { return alignment == Alignment::kNone ? "none" : "rigid"; }

Alignment alignment_from_string(std::string_view name) {
  if (name == "none") return Alignment::kNone;
  if (name == "rigid") return Alignment::kRigid;
  throw ConfigurationError("alignment", "'" + std::string(name) + "' is not known", "use none or rigid");
}

Pose2 rigid_alignment(std::span<const PosePair> pairs) {
  if (pairs.empty()) return {};
  const Centroids c = centroids(pairs);
  const Pose2 turn{0.0, 0.0, best_turn(pairs, c)};
  const Point2 turned = turn * c.estimate;
  return {c.reference.x - turned.x, c.reference.y - turned.y, turn.theta};
}

std::vector<PosePair> aligned(std::span<const PosePair> pairs, const Pose2& T_reference_estimate) {
  std::vector<PosePair> moved(pairs.begin(), pairs.end());
  for (auto& pair : moved) pair.estimate = T_reference_estimate * pair.estimate;
  return moved;
}

}  // namespace cairn
