#include "cairn/sim/world_sonar.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr int kMostSurfaces = 24;
constexpr int kMostTurns = 2;
constexpr double kRayStep_rad = 0.035;  // two degrees

std::optional<double> shortest_echo(const WorldScene& scene, const WorldSonarOptions& o,
                                    const Pose2& T_map_transducer) {
  const int rays = 1 + static_cast<int>(std::ceil(o.cone_rad / kRayStep_rad));
  std::optional<double> shortest;
  for (int ray = 0; ray <= rays; ++ray) {
    const double angle = T_map_transducer.theta + o.cone_rad * (static_cast<double>(ray) / rays - 0.5);
    const auto echo = sonar_echo(scene, o, {T_map_transducer.x, T_map_transducer.y}, angle);
    if (echo && (!shortest || *echo < *shortest)) shortest = echo;
  }
  return shortest;
}

double measured_range(std::optional<double> echo, const WorldSonarOptions& o, const RandomStream& random,
                      std::uint32_t transducer) {
  const auto fate = random.uniform4(transducer, 1);
  if (fate[0] < o.crosstalk_share) return std::lerp(o.range_min_m, o.range_max_m, fate[2]);
  if (!echo || fate[1] < o.lost_echo_share) return o.range_max_m;
  const double sigma = o.sigma_range_m + o.sigma_share * *echo;
  return std::clamp(*echo + sigma * random.normal4(transducer, 0)[0], o.range_min_m, o.range_max_m);
}

}  // namespace

std::optional<double> sonar_echo(const WorldScene& scene, const WorldSonarOptions& o, const Point2& origin,
                                 double angle_rad) {
  Point2 at = origin;
  Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  double travelled = 0.0;
  int turns = 0;
  for (int surface = 0; surface < kMostSurfaces && travelled < o.range_max_m; ++surface) {
    const auto met = scene.nearest(at, direction, o.range_max_m - travelled);
    if (!met) return std::nullopt;
    travelled += met->range_m + WorldScene::kPassed_m;
    const bool is_there = met->span.contains(o.height_m);
    if (is_there && met->incidence_rad(direction) <= o.critical_rad) return travelled;
    if (is_there && ++turns > kMostTurns) return std::nullopt;
    at = {at.x + met->range_m * direction.x, at.y + met->range_m * direction.y};
    if (is_there) direction = reflected(direction, met->along);
    at = {at.x + WorldScene::kPassed_m * direction.x, at.y + WorldScene::kPassed_m * direction.y};
  }
  return std::nullopt;
}

SonarScan simulate_sonar(const SensorView& view, const WorldSonarOptions& o) {
  const WorldScene scene = view.scene();
  const RandomStream random = view.random(SimulationUse::kSonarNoise);
  const Pose2 T_map_sensor = view.base_in_map() * parse_world_pose("mount", o.mount);
  SonarScan scan{view.stamp, o.range_min_m, o.range_max_m, o.cone_rad, {}, {}};
  for (int i = 0; i < o.transducers; ++i) {
    const Pose2 T_sensor_ring{0.0, 0.0, normalize_angle(kTwoPi * i / o.transducers)};
    scan.T_sensor_transducer.push_back(T_sensor_ring * Pose2{o.ring_m, 0.0, 0.0});
    const auto echo = shortest_echo(scene, o, T_map_sensor * scan.T_sensor_transducer.back());
    const double range = measured_range(echo, o, random, static_cast<std::uint32_t>(i));
    scan.ranges_m.push_back(static_cast<float>(range));
  }
  return scan;
}

}  // namespace cairn
