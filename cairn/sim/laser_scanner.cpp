#include "cairn/sim/laser_scanner.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/sim/ray_caster.hpp"
#include "cairn/sim/simulation_random.hpp"

#include <algorithm>

namespace cairn {
namespace {

float measure(std::optional<double> truth, const LaserScannerOptions& o, const RandomStream& random,
              std::uint32_t beam) {
  const auto no_return = static_cast<float>(o.range_max_m);
  if (!truth || random.uniform(beam, 1) < o.dropout_probability) return no_return;
  const double range = *truth + o.sigma_range_m * random.normal4(beam, 0)[0];
  return static_cast<float>(std::clamp(range, 0.0, o.range_max_m));
}

}  // namespace

void LaserScannerOptions::validate() const {
  const bool valid = field_of_view_rad > 0.0 && field_of_view_rad <= kTwoPi && beams >= 2 &&
                     beams <= 100'000 && range_min_m >= 0.0 && range_max_m > range_min_m &&
                     sigma_range_m >= 0.0 && dropout_probability >= 0.0 && dropout_probability <= 1.0;
  if (!valid) throw ConfigurationError("laser scanner", "an option is out of range", "see laser_scanner.hpp");
}

LaserScan simulate_scan(const FloorPlan& plan, const Pose2& T_map_laser, Time stamp,
                        const LaserScannerOptions& options, std::uint64_t seed, std::uint64_t index) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.angle_min_rad = -0.5 * options.field_of_view_rad;
  scan.angle_increment_rad = options.field_of_view_rad / (options.beams - 1);
  scan.range_min_m = options.range_min_m;
  scan.range_max_m = options.range_max_m;
  const RandomStream random = simulation_random(seed, SimulationUse::kLaserNoise, index);
  for (int beam = 0; beam < options.beams; ++beam) {
    const double angle = scan.angle_min_rad + beam * scan.angle_increment_rad;
    const auto truth = cast_ray(plan, T_map_laser * Pose2{0.0, 0.0, angle});
    scan.ranges_m.push_back(measure(truth, options, random, static_cast<std::uint32_t>(beam)));
  }
  return scan;
}

}  // namespace cairn
