#include "cairn/models/sensor/likelihood_field_reference.hpp"

#include "cairn/models/sensor/end_point_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cairn {
namespace {

// Distance of a point to the nearest wall, metres; the largest one off the map.
double distance_at(const DistanceField& field, const Point2& p_map) {
  const GridGeometry& grid = field.geometry();
  const Point2 cell = grid.to_cells(p_map);
  const bool on_map = cell.x >= 0.0 && cell.x < grid.width && cell.y >= 0.0 && cell.y < grid.height;
  return on_map ? field.distance_m(grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y)))
                : field.max_distance_m();
}

}  // namespace

LikelihoodFieldReference::LikelihoodFieldReference(std::shared_ptr<const DistanceField> field,
                                                   const Pose2& T_base_sensor, const BeamLimits& limits,
                                                   const LikelihoodFieldOptions& options)
    : field_(std::move(field)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

BoundUpdate<Pose2> LikelihoodFieldReference::bind(const LaserScan& scan) const {
  std::vector<Point2> points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const double scale = options_.share_of(points.size());
  const auto evaluate = [field = field_, options = options_, points = std::move(points), scale](
                            std::span<const Pose2> states, std::span<double> out) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      double sum = 0.0;
      for (const Point2& p : points) sum += options.log_likelihood(distance_at(*field, states[i] * p));
      out[i] = scale * sum;
    }
  };
  return {scan.stamp, evaluate};
}

double LikelihoodFieldReference::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  return share_near_walls(*field_, points, T_map_base, options_.explained_within_m());
}

}  // namespace cairn
