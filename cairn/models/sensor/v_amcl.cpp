#include "cairn/models/sensor/v_amcl.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kExplainedSigmas = 3.0;

struct PreparedScan {
  std::vector<Point2> points;  ///< base frame
  double scale = 1.0;
};

// Calls `visit(end point relative to the base, offset from the nearest wall or nullptr)` for each beam, both
// along the map's axes.
template <class Visit>
void for_each_point(const PreparedScan& scan, const Pose2& T_map_base, const WallDistance& walls,
                    const Visit& visit) {
  const double c = std::cos(T_map_base.theta), s = std::sin(T_map_base.theta);
  for (const Point2& p : scan.points) {
    const Point2 end{c * p.x - s * p.y, s * p.x + c * p.y};
    const Point2 at{T_map_base.x + end.x, T_map_base.y + end.y};
    const auto nearest = walls.nearest(at);
    const Point2 offset = nearest ? Point2{at.x - nearest->x, at.y - nearest->y} : Point2{};
    visit(end, nearest ? &offset : nullptr);
  }
}

double log_likelihood_at(const PreparedScan& scan, const Pose2& T_map_base, const WallDistance& walls,
                         const LikelihoodFieldOptions& o) {
  const double per_m2 = 1.0 / (2.0 * o.sigma_hit_m * o.sigma_hit_m);
  const double far = o.max_distance_m * o.max_distance_m;
  double sum = 0.0;
  for_each_point(scan, T_map_base, walls, [&](const Point2&, const Point2* offset) {
    const double d2 = offset == nullptr ? far : offset->x * offset->x + offset->y * offset->y;
    sum += std::log(o.z_hit * std::exp(-d2 * per_m2) + o.z_rand);
  });
  return scan.scale * sum;
}

Eigen::Vector3d gradient_at(const PreparedScan& scan, const Pose2& T_map_base, const WallDistance& walls,
                            const LikelihoodFieldOptions& o) {
  const double per_m2 = 1.0 / (2.0 * o.sigma_hit_m * o.sigma_hit_m);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_point(scan, T_map_base, walls, [&](const Point2& end, const Point2* offset) {
    if (offset == nullptr) return;
    const double hit = o.z_hit * std::exp(-(offset->x * offset->x + offset->y * offset->y) * per_m2);
    const double slope = -hit / (hit + o.z_rand) * 2.0 * per_m2;
    sum += slope * Eigen::Vector3d(offset->x, offset->y, offset->y * end.x - offset->x * end.y);
  });
  return scan.scale * sum;
}

PreparedScan prepare(const LaserScan& scan, const Pose2& T_base_sensor, const BeamLimits& limits,
                     const LikelihoodFieldOptions& o) {
  PreparedScan prepared{select_end_points(scan, T_base_sensor, limits, o.max_beams), 1.0};
  const double beams = std::max<double>(1.0, static_cast<double>(prepared.points.size()));
  prepared.scale = std::min(1.0, o.effective_beams / beams);
  return prepared;
}

}  // namespace

VectorAmcl::VectorAmcl(std::shared_ptr<const WallDistance> walls, const Pose2& T_base_sensor,
                       const BeamLimits& limits, const LikelihoodFieldOptions& options)
    : walls_(std::move(walls)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

BoundUpdate<Pose2> VectorAmcl::bind(const LaserScan& scan) const {
  const auto prepared =
      std::make_shared<const PreparedScan>(prepare(scan, T_base_sensor_, limits_, options_));
  const auto log_likelihood = [prepared, walls = walls_, o = options_](std::span<const Pose2> states,
                                                                       std::span<double> out) {
    for (std::size_t i = 0; i < states.size(); ++i)
      out[i] = log_likelihood_at(*prepared, states[i], *walls, o);
  };
  const auto gradient = [prepared, walls = walls_, o = options_](std::span<const Pose2> states,
                                                                 std::span<Eigen::Vector3d> out) {
    for (std::size_t i = 0; i < states.size(); ++i) out[i] = gradient_at(*prepared, states[i], *walls, o);
  };
  return {.stamp = scan.stamp, .log_likelihood = log_likelihood, .gradient = gradient};
}

double VectorAmcl::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const PreparedScan prepared = prepare(scan, T_base_sensor_, limits_, options_);
  const double within = kExplainedSigmas * options_.sigma_hit_m;
  std::size_t explained = 0;
  for_each_point(prepared, T_map_base, *walls_, [&](const Point2&, const Point2* offset) {
    explained += offset != nullptr && std::hypot(offset->x, offset->y) <= within ? 1 : 0;
  });
  return prepared.points.empty()
             ? 0.0
             : static_cast<double>(explained) / static_cast<double>(prepared.points.size());
}

}  // namespace cairn
