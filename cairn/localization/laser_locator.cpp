#include "cairn/localization/laser_locator.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace cairn {
namespace {

constexpr int kBeamsOfOne = 180;     // of a single scan
constexpr int kBeamsOfSeveral = 60;  // of each, where scans are joined

const LaserScan& scan_of(const Event::Payload& z) { return *std::get<std::shared_ptr<const LaserScan>>(z); }

double free_volume(const OccupancyGrid& map) {
  const double cell_m = map.geometry().resolution_m;
  return std::max(1.0, static_cast<double>(map.count(CellState::kFree))) * cell_m * cell_m * kTwoPi;
}

// Laplace: the integral of the likelihood around a mode.
double log_mass(const LocatedPose& mode) {
  const double determinant = std::max(mode.covariance.determinant(), 1e-18);
  return mode.log_likelihood + 1.5 * std::log(kTwoPi) + 0.5 * std::log(determinant);
}

}  // namespace

const PoseSearch& LaserLocator::prepared() const {
  std::call_once(once_, [this] { search_ = std::make_unique<const PoseSearch>(*map_, options_.likelihood); });
  return *search_;
}

std::vector<LocatedPose> LaserLocator::locate(const LaserScan& scan) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, kBeamsOfOne);
  return cairn::locate(prepared(), points, options_.search).poses;
}

std::vector<Point2> LaserLocator::joined(std::span<const Glimpse> glimpses) const {
  std::vector<Point2> points;
  for (const Glimpse& glimpse : glimpses) {
    for (const Point2& p : select_end_points(scan_of(glimpse.z), T_base_sensor_, limits_, kBeamsOfSeveral))
      points.push_back(glimpse.T_now_then * p);
  }
  return points;
}

SearchFinding LaserLocator::search(std::span<const Glimpse> glimpses, std::span<const Pose2> asked) const {
  SearchFinding finding;
  const std::vector<Point2> points = joined(glimpses);
  if (points.empty()) return finding;
  OneShotOptions options = options_.search;
  options.effective_beams += options_.further_beams * (static_cast<double>(glimpses.size()) - 1.0);
  finding.poses = cairn::locate(prepared(), points, options).poses;
  if (finding.poses.empty()) return finding;
  std::vector<double> masses;
  for (const LocatedPose& pose : finding.poses) masses.push_back(log_mass(pose));
  finding.log_evidence = log_sum_exp(masses) - std::log(free_volume(*map_));
  const double scale = std::min(1.0, options.effective_beams / static_cast<double>(points.size()));
  for (const Pose2& pose : asked)
    finding.log_likelihood.push_back(scale * prepared().log_likelihood(points, pose));
  return finding;
}

}  // namespace cairn
