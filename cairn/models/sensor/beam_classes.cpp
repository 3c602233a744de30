#include "cairn/models/sensor/beam_classes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kHit = 0.85;
constexpr double kElsewhere = 0.15;
constexpr double kLargestResidual = 2.0;

double bearing_of(const LaserScan& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.angle_increment_rad;
}

}  // namespace

BeamShares on_the_map(const BeamShares& seen) {
  BeamShares known = seen;
  const double share = 1.0 - seen.unknown;
  known.beams = static_cast<int>(std::lround(share * seen.beams));
  if (known.beams == 0) return {.missing = seen.missing};
  for (double* figure : {&known.explained, &known.blocked, &known.beyond, &known.residual}) *figure /= share;
  known.fit = (seen.fit - seen.unknown * std::log(kElsewhere)) / share;
  known.unknown = 0.0;
  return known;
}

BeamClassifier::BeamClassifier(std::shared_ptr<const OccupancyGrid> map,
                               std::shared_ptr<const DistanceField> walls,
                               std::shared_ptr<const RayMarcher> rays, const Pose2& T_base_sensor,
                               const BeamLimits& limits, const BeamClassOptions& options)
    : map_(std::move(map)),
      walls_(std::move(walls)),
      rays_(std::move(rays)),
      T_base_sensor_(T_base_sensor),
      limits_(limits),
      options_(options) {}

double BeamClassifier::wall_distance_m(const Point2& p) const {
  const GridGeometry& grid = walls_->geometry();
  const Point2 cell = grid.to_cells(p);
  const bool on_map = cell.x >= 0.0 && cell.x < grid.width && cell.y >= 0.0 && cell.y < grid.height;
  return on_map ? walls_->distance_m(grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y)))
                : walls_->max_distance_m();
}

BeamClassifier::Class BeamClassifier::class_of(double range_m, double expected_m, const Point2& end) const {
  const double tolerance_m = options_.tolerance_m + options_.tolerance_rad * range_m;
  const bool at_a_wall = wall_distance_m(end) <= tolerance_m;
  if (range_m > expected_m + tolerance_m && !at_a_wall)
    return map_->state_at(end) == CellState::kFree ? Class::kBeyond : Class::kUnknown;
  if (at_a_wall || range_m >= expected_m - tolerance_m) return Class::kExplained;
  return map_->state_at(end) == CellState::kUnknown ? Class::kUnknown : Class::kBlocked;
}

double BeamClassifier::share_within_reach(const LaserScan& scan, const Pose2& T_map_sensor) const {
  const std::size_t count =
      std::min<std::size_t>(scan.ranges_m.size(), static_cast<std::size_t>(options_.beams));
  if (count == 0) return 1.0;  // it has no beams at all
  std::vector<double> bearings(count);
  for (std::size_t i = 0; i < count; ++i) bearings[i] = bearing_of(scan, i * scan.ranges_m.size() / count);
  std::vector<float> expected_m(count);
  rays_->cast({&T_map_sensor, 1}, bearings, expected_m);
  const double reach = std::min({reach_m(scan, limits_), rays_->max_range_m()}) - options_.tolerance_m;
  const auto within = std::count_if(expected_m.begin(), expected_m.end(), [&](float m) { return m < reach; });
  return static_cast<double>(within) / static_cast<double>(count);
}

BeamShares BeamClassifier::classify(const LaserScan& scan, const Pose2& T_map_base) const {
  const std::vector<std::size_t> beams = select_beams(scan, limits_, options_.beams);
  BeamShares shares;
  if (beams.empty()) {
    shares.missing = share_within_reach(scan, T_map_base * T_base_sensor_);
    return shares;
  }
  shares.beams = static_cast<int>(beams.size());
  const double one = 1.0 / static_cast<double>(beams.size());
  const Pose2 T_map_sensor = T_map_base * T_base_sensor_;
  std::vector<double> bearings(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) bearings[i] = bearing_of(scan, beams[i]);
  std::vector<float> expected_m(beams.size());
  rays_->cast({&T_map_sensor, 1}, bearings, expected_m);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double range_m = scan.ranges_m[beams[i]];
    const Point2 end =
        T_map_sensor * Point2{range_m * std::cos(bearings[i]), range_m * std::sin(bearings[i])};
    const double off = wall_distance_m(end) / options_.sigma_m;
    shares.fit += one * std::log(kHit * std::exp(-0.5 * off * off) + kElsewhere);
    switch (class_of(range_m, expected_m[i], end)) {
      case Class::kExplained:
        shares.explained += one;
        shares.residual += one * std::min(0.5 * off * off, kLargestResidual);
        break;
      case Class::kBlocked:
        shares.blocked += one;
        break;
      case Class::kBeyond:
        shares.beyond += one;
        break;
      case Class::kUnknown:
        shares.unknown += one;
        break;
    }
  }
  return shares;
}

}  // namespace cairn
