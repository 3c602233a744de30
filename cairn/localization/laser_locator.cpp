#include "cairn/localization/laser_locator.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kBeamsOfOne = 180;     // of a single scan
constexpr int kBeamsOfSeveral = 60;  // of each, where scans are joined
constexpr int kCandidates = 3;       // per place that is kept
constexpr int kBeamsOfJoined = 40;   // likewise, where many places are looked for
// Of a place that the way was fitted to.
const Eigen::Matrix3d kSpread = Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal();

const LaserScan& scan_of(const Event::Payload& z) { return *std::get<std::shared_ptr<const LaserScan>>(z); }

}  // namespace

const PoseSearch& LaserLocator::prepared() const {
  std::call_once(once_, [this] { search_ = std::make_unique<const PoseSearch>(*map_, options_.likelihood); });
  return *search_;
}

// One scan is weighed by what lies around each pose; several by the way that led there, which fits each
// place.
std::vector<LocatedPose> LaserLocator::locate(std::span<const Glimpse> glimpses,
                                              std::span<const Pose2> asked) const {
  if (glimpses.size() == 1) {
    const auto points = select_end_points(scan_of(glimpses[0].z), T_base_sensor_, limits_, kBeamsOfOne);
    return cairn::locate(prepared(), points, options_.search).poses;
  }
  const std::size_t newest = std::min(glimpses.size(), static_cast<std::size_t>(options_.joined));
  const std::vector<Point2> points = joined(glimpses.last(newest), kBeamsOfJoined);
  const OneShotOptions& search = options_.search;
  std::vector<LocatedPose> places;
  for (const FoundPose& found :
       prepared()
           .find(points, {.most_poses = kCandidates * search.most_poses,
                         .separation_m = search.separation_m,
                         .separation_rad = search.separation_rad,
                         .budget = static_cast<std::int64_t>(search.millions_of_points * 1e6)})
           .poses)
    places.push_back({.T_map_base = found.T_map_base, .covariance = kSpread});
  for (const Pose2& pose : asked) places.push_back({.T_map_base = pose, .covariance = kSpread});
  if (!places.empty()) weigh(looks(glimpses), places);
  return places;
}

std::vector<PathLook> LaserLocator::looks(std::span<const Glimpse> glimpses) const {
  std::vector<PathLook> looks;
  for (const Glimpse& glimpse : glimpses)
    looks.push_back({select_end_points(scan_of(glimpse.z), T_base_sensor_, limits_, kBeamsOfSeveral),
                     glimpse.T_now_then});
  return looks;
}

// Each place is fitted to the newest look; of those that come to lie together, the best is kept.
void LaserLocator::weigh(std::span<const PathLook> path, std::vector<LocatedPose>& places) const {
  for (LocatedPose& place : places) {
    const PathScore score = score_path(prepared(), path, place.T_map_base);
    place.T_map_base = score.T_map_now;
    place.log_likelihood = options_.further_beams * score.log_likelihood;
  }
  std::stable_sort(places.begin(), places.end(), [](const LocatedPose& a, const LocatedPose& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  const double least = places[0].log_likelihood + std::log(options_.search.least_weight);
  std::vector<LocatedPose> kept;
  for (const LocatedPose& place : places) {
    if (place.log_likelihood < least || kept.size() == static_cast<std::size_t>(options_.search.most_poses))
      break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const LocatedPose& other) {
      return distance(place.T_map_base, other.T_map_base) < options_.search.separation_m &&
             std::abs(normalize_angle(place.T_map_base.theta - other.T_map_base.theta)) <
                 options_.search.separation_rad;
    });
    if (!known) kept.push_back(place);
  }
  std::vector<double> log_weights;
  log_weights.reserve(kept.size());
  for (const LocatedPose& place : kept) log_weights.push_back(place.log_likelihood);
  normalize_log_weights(log_weights);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].weight = std::exp(log_weights[i]);
  places = std::move(kept);
}

std::vector<Point2> LaserLocator::joined(std::span<const Glimpse> glimpses, int beams,
                                         double farther_than_m) const {
  std::vector<Point2> points;
  for (const Glimpse& glimpse : glimpses) {
    for (const Point2& p : select_end_points(scan_of(glimpse.z), T_base_sensor_, limits_, beams)) {
      if (from_sensor(p) >= farther_than_m) points.push_back(glimpse.T_now_then * p);
    }
  }
  return points;
}

double LaserLocator::from_sensor(const Point2& p) const {
  return std::hypot(p.x - T_base_sensor_.x, p.y - T_base_sensor_.y);
}

bool LaserLocator::surrounded(const Glimpse& glimpse) const {
  const auto points = select_end_points(scan_of(glimpse.z), T_base_sensor_, limits_, kBeamsOfSeveral);
  const auto near = std::count_if(points.begin(), points.end(),
                                  [&](const Point2& p) { return from_sensor(p) < options_.crowd_m; });
  return 2 * static_cast<std::size_t>(near) > points.size();
}

// Where people stand around the robot, a nook of the map explains the most beams; where it is, only those
// that pass between them reach a wall.
std::vector<LocatedPose> LaserLocator::search(std::span<const Glimpse> glimpses) const {
  std::vector<LocatedPose> places = located(joined(glimpses, kBeamsOfSeveral), glimpses.size());
  if (!glimpses.empty() && surrounded(glimpses.back())) {
    const auto between = located(joined(glimpses, kBeamsOfOne, options_.crowd_m), glimpses.size());
    places.insert(places.end(), between.begin(), between.end());
  }
  return places;
}

std::vector<LocatedPose> LaserLocator::located(const std::vector<Point2>& points, std::size_t scans) const {
  if (points.empty()) return {};
  OneShotOptions options = options_.search;
  options.effective_beams += options_.further_beams * (static_cast<double>(scans) - 1.0);
  return cairn::locate(prepared(), points, options).poses;
}

}  // namespace cairn
