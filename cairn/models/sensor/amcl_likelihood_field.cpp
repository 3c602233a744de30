#include "cairn/models/sensor/amcl_likelihood_field.hpp"

#include "cairn/models/sensor/end_point_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cairn {
namespace {

constexpr double kExplainedSigmas = 3.0;

// Distance to the nearest wall in metres, for points in cells of the grid; the largest one off the map.
double distance_at(const DistanceField& field, double column, double row) {
  const GridGeometry& grid = field.geometry();
  if (!(column >= 0.0 && column < grid.width && row >= 0.0 && row < grid.height))
    return field.max_distance_m();
  return field.distance_m(grid.index(static_cast<int>(column), static_cast<int>(row)));
}

}  // namespace

AmclLikelihoodField::AmclLikelihoodField(std::shared_ptr<const DistanceField> field,
                                         const Pose2& T_base_sensor, const BeamLimits& limits,
                                         const LikelihoodFieldOptions& options)
    : field_(std::move(field)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

BoundUpdate<Pose2> AmclLikelihoodField::bind(const LaserScan& scan) const {
  const GridGeometry& grid = field_->geometry();
  std::vector<Point2> points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  for (Point2& p : points) p = {p.x / grid.resolution_m, p.y / grid.resolution_m};
  const double random = options_.z_rand / std::max(1.0, std::min(scan.range_max_m, limits_.max_range_m));
  const double steepness = -0.5 / (options_.sigma_hit_m * options_.sigma_hit_m);
  const auto evaluate = [field = field_, T_grid_map = inverse(grid.T_map_grid), points = std::move(points),
                         cells_per_m = 1.0 / grid.resolution_m, z_hit = options_.z_hit, random,
                         steepness](std::span<const Pose2> states, std::span<double> out) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Pose2 T_grid_base = T_grid_map * states[i];
      const double x = T_grid_base.x * cells_per_m, y = T_grid_base.y * cells_per_m;
      const double c = std::cos(T_grid_base.theta), s = std::sin(T_grid_base.theta);
      double sum = 1.0;
      for (const Point2& p : points) {
        const double d = distance_at(*field, x + c * p.x - s * p.y, y + s * p.x + c * p.y);
        const double likelihood = z_hit * std::exp(steepness * d * d) + random;
        sum += likelihood * likelihood * likelihood;
      }
      out[i] = std::log(sum);
    }
  };
  return {scan.stamp, evaluate};
}

double AmclLikelihoodField::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  return share_near_walls(*field_, points, T_map_base, kExplainedSigmas * options_.sigma_hit_m);
}

}  // namespace cairn
