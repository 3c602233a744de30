#include "cairn/sim/world_landmarks.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kSightHeight_m = 1.0;
constexpr int kMostFalse = 1000;

// Items of the random numbers: the landmarks come first, then what is seen where nothing is.
constexpr std::uint32_t kFalseItems = std::uint32_t{1} << 24;
enum Draw : std::uint16_t { kNoise = 0, kFate = 1 };

bool is_hidden(const WorldScene& scene, const Point2& from, const Point2& to) {
  bool hidden = false;
  scene.visit_between(from, to, [&hidden](const WorldScene::Surface& surface) {
    hidden = surface.material != Material::kGlass && surface.span.contains(kSightHeight_m);
    return !hidden;
  });
  return hidden;
}

int id_drawn(std::span<const PlacedLandmark> landmarks, double u) {
  const auto i = static_cast<std::size_t>(u * static_cast<double>(landmarks.size()));
  return landmarks[std::min(i, landmarks.size() - 1)].id;
}

// Poisson (Knuth, "The Art of Computer Programming", vol. 2, 3.4.1): uniform numbers until their product is
// small.
int poisson(double mean, const RandomStream& random) {
  const double limit = std::exp(-mean);
  double product = random.uniform(kFalseItems, kFate);
  int count = 0;
  while (product > limit && count < kMostFalse)
    product *= random.uniform(kFalseItems + static_cast<std::uint32_t>(++count), kFate);
  return count;
}

void add_false(const WorldLandmarkDetectorOptions& o, std::span<const PlacedLandmark> landmarks,
               const RandomStream& random, std::vector<LandmarkDetection>& detections) {
  const int count = poisson(o.false_per_scan, random);
  for (int i = 0; i < count; ++i) {
    const auto u = random.uniform4(kFalseItems + static_cast<std::uint32_t>(i), kNoise);
    detections.push_back({id_drawn(landmarks, u[0]), u[1] * o.range_max_m,
                          normalize_angle((u[2] - 0.5) * o.field_of_view_rad)});
  }
}

}  // namespace

std::vector<PlacedLandmark> make_landmarks(const std::vector<WorldLandmarkOptions>& options) {
  std::vector<PlacedLandmark> landmarks;
  landmarks.reserve(options.size());
  for (const WorldLandmarkOptions& o : options)
    landmarks.push_back({parse_point("landmarks." + o.name + ".at", o.at), o.id});
  return landmarks;
}

LandmarkDetections simulate_landmarks(const SensorView& view, const WorldLandmarkDetectorOptions& o,
                                      std::span<const PlacedLandmark> landmarks) {
  const WorldScene scene = view.scene();
  const RandomStream random = view.random(SimulationUse::kLandmarkNoise);
  const Pose2 T_map_sensor = view.base_in_map() * parse_world_pose("mount", o.mount);
  LandmarkDetections seen{view.stamp, o.range_max_m, o.field_of_view_rad, {}};
  for (std::uint32_t i = 0; i < landmarks.size(); ++i) {
    const Point2 in_sensor = inverse(T_map_sensor) * landmarks[i].at;
    const double range = std::hypot(in_sensor.x, in_sensor.y);
    const double bearing = std::atan2(in_sensor.y, in_sensor.x);
    if (range > o.range_max_m || std::abs(bearing) > 0.5 * o.field_of_view_rad) continue;
    if (is_hidden(scene, {T_map_sensor.x, T_map_sensor.y}, landmarks[i].at)) continue;
    const auto fate = random.uniform4(i, kFate);
    if (fate[0] < o.missed_share) continue;
    const auto noise = random.normal4(i, kNoise);
    const int id = fate[1] < o.wrong_id_share ? id_drawn(landmarks, fate[2]) : landmarks[i].id;
    const double sigma_m = o.sigma_range_m + o.sigma_range_share * range;
    seen.detections.push_back({id, std::max(0.0, range + sigma_m * noise[0]),
                               normalize_angle(bearing + o.sigma_bearing_rad * noise[1])});
  }
  add_false(o, landmarks, random, seen.detections);
  return seen;
}

}  // namespace cairn
