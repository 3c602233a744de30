#include "cairn/models/sensor/likelihood_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace cairn {
namespace {

double square(double x) { return x * x; }

}  // namespace

void LikelihoodFieldOptions::visit(OptionVisitor& v) {
  v.number({"z_hit", "weight of the beams that end at a wall of the map", {"laser_z_hit"}}, z_hit,
           {0.0, 1.0});
  v.number({"z_rand", "weight of the beams that end anywhere", {"laser_z_rand"}}, z_rand, {1e-9, 1.0});
  v.number({"sigma_hit_m",
            "standard deviation of the end points' distance to the wall, metres",
            {"sigma_hit", "laser_sigma_hit"}},
           sigma_hit_m, {1e-3, 10.0});
  v.number({"max_distance_m",
            "distances to the nearest wall beyond this count as this, metres",
            {"laser_likelihood_max_dist"}},
           max_distance_m, {0.01, 100.0});
  v.integer({"max_beams",
             "evaluated beams per scan, spread evenly over the valid ones; 0: all",
             {"laser_max_beams"}},
            max_beams, {0, 100000});
  v.number({"effective_beams", "a scan never counts for more than this many independent beams"},
           effective_beams, {0.1, 100000});
}

double LikelihoodFieldOptions::log_likelihood(double distance_m) const {
  return std::log(z_hit * std::exp(-square(distance_m / sigma_hit_m) / 2.0) + z_rand);
}

double LikelihoodFieldOptions::share_of(std::size_t beams) const {
  return std::min(1.0, effective_beams / std::max(1.0, static_cast<double>(beams)));
}

// A bit per cell: is it within reach of a wall?
class LikelihoodField::NearWalls {
 public:
  NearWalls(const DistanceField& field, double within_m)
      : geometry_(field.geometry()), near_(field.geometry().size()) {
    for (std::size_t i = 0; i < near_.size(); ++i) near_[i] = field.distance_m(i) <= within_m;
  }

  bool operator()(const Point2& p_map) const {
    const Point2 cell = geometry_.to_cells(p_map);
    const bool on_map =
        cell.x >= 0.0 && cell.x < geometry_.width && cell.y >= 0.0 && cell.y < geometry_.height;
    return on_map && near_[geometry_.index(static_cast<int>(cell.x), static_cast<int>(cell.y))];
  }

 private:
  GridGeometry geometry_;
  std::vector<bool> near_;
};

namespace {

// Rounding to steps gives each beam an error of step / sqrt(12); the sum of as many as count at most, in nat,
// shall not exceed this.
constexpr double kLargestRounding = 0.025;

LikelihoodPlane::Codes codes_for(const LikelihoodFieldOptions& o, double max_distance_m) {
  const double step = (o.log_likelihood(0.0) - o.log_likelihood(max_distance_m)) / 255.0;
  const double beams = o.max_beams > 0 ? std::min<double>(o.effective_beams, o.max_beams) : o.effective_beams;
  const double error = step / std::sqrt(12.0) * std::sqrt(beams);
  return error <= kLargestRounding ? LikelihoodPlane::Codes::k8Bit : LikelihoodPlane::Codes::k16Bit;
}

}  // namespace

LikelihoodField::LikelihoodField(const std::shared_ptr<const DistanceField>& field,
                                 const Pose2& T_base_sensor, const BeamLimits& limits,
                                 const LikelihoodFieldOptions& options)
    : plane_(std::make_shared<const LikelihoodPlane>(
          *field, codes_for(options, field->max_distance_m()),
          [&](double distance_m) { return options.log_likelihood(distance_m); })),
      near_walls_(std::make_shared<const NearWalls>(*field, options.explained_within_m())),
      T_base_sensor_(T_base_sensor),
      limits_(limits),
      options_(options) {}

namespace {

// One scan, seen through the plane.
class ScanOnPlane {
 public:
  ScanOnPlane(std::shared_ptr<const LikelihoodPlane> plane, std::vector<Point2> points, double scale)
      : plane_(std::move(plane)),
        points_(std::move(points)),
        beams_(plane_->in_cells(points_)),
        scale_(scale) {}

  void evaluate(std::span<const Pose2> states, std::span<double> out) const {
    constexpr std::size_t kAtOnce = 1024;
    std::array<std::uint32_t, kAtOnce> sums;
    for (std::size_t begin = 0; begin < states.size(); begin += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, states.size() - begin);
      plane_->sum_codes(beams_, states.subspan(begin, count), std::span(sums).first(count));
      for (std::size_t i = 0; i < count; ++i)
        out[begin + i] = scale_ * plane_->log_likelihood(beams_.count, sums[i]);
    }
  }

  void differentiate(std::span<const Pose2> states, std::span<Eigen::Vector3d> out) const {
    for (std::size_t i = 0; i < states.size(); ++i)
      out[i] = scale_ * plane_->interpolate(points_, states[i]).tail<3>();
  }

 private:
  std::shared_ptr<const LikelihoodPlane> plane_;
  std::vector<Point2> points_;
  BeamsInCells beams_;
  double scale_;
};

}  // namespace

BoundUpdate<Pose2> LikelihoodField::bind(const LaserScan& scan) const {
  auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const double scale = options_.share_of(points.size());
  const auto prepared = std::make_shared<const ScanOnPlane>(plane_, std::move(points), scale);
  BoundUpdate<Pose2> update;
  update.stamp = scan.stamp;
  update.log_likelihood = [prepared](std::span<const Pose2> states, std::span<double> out) {
    prepared->evaluate(states, out);
  };
  update.gradient = [prepared](std::span<const Pose2> states, std::span<Eigen::Vector3d> out) {
    prepared->differentiate(states, out);
  };
  return update;
}

double LikelihoodField::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const auto explained = std::count_if(points.begin(), points.end(),
                                       [&](const Point2& p) { return (*near_walls_)(T_map_base * p); });
  return points.empty() ? 0.0 : static_cast<double>(explained) / static_cast<double>(points.size());
}

}  // namespace cairn
