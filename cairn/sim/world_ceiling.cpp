#include "cairn/sim/world_ceiling.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kTile = 160.0, kTileSpread = 40.0, kLamp = 245.0, kJoint = 80.0, kStains = 30.0;
constexpr double kJoint_m = 0.015;
constexpr double kStain_m = 0.3;

enum Layer : std::uint8_t { kTiles = 0, kCorners = 1 };

// A uniform number for a cell of an endless grid.
double number_of(const WorldCeilingOptions& o, Layer layer, double column, double row) {
  const auto word = [](double index) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(index)); };
  const std::uint64_t step = (std::uint64_t{layer} << 32) | word(row);
  return simulation_random(static_cast<std::uint64_t>(o.pattern), SimulationUse::kCeilingTexture, step)
      .uniform(word(column));
}

// Smooth between the numbers of the grid's corners (value noise).
double stain(const WorldCeilingOptions& o, const Point2& point) {
  const double x = point.x / kStain_m, y = point.y / kStain_m;
  const double column = std::floor(x), row = std::floor(y);
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double sx = smooth(x - column), sy = smooth(y - row);
  const auto corner = [&](int i, int k) { return number_of(o, kCorners, column + i, row + k); };
  return std::lerp(std::lerp(corner(0, 0), corner(1, 0), sx), std::lerp(corner(0, 1), corner(1, 1), sx), sy);
}

}  // namespace

double ceiling_gray(const WorldCeilingOptions& o, const Point2& point) {
  const double x = point.x / o.tile_m, y = point.y / o.tile_m;
  const double column = std::floor(x), row = std::floor(y);
  const double joint = 0.5 * kJoint_m / o.tile_m;
  const auto is_joint = [joint](double within) { return within < joint || within > 1.0 - joint; };
  if (is_joint(x - column) || is_joint(y - row)) return kJoint;
  const double tile = number_of(o, kTiles, column, row);
  if (tile < o.lamp_share) return kLamp;
  return kTile + kTileSpread * (tile - 0.5) + kStains * (stain(o, point) - 0.5);
}

CeilingPatch simulate_ceiling(const SensorView& view, const WorldCeilingCameraOptions& o) {
  const WorldCeilingOptions& ceiling = view.drive.world.options.ceiling;
  const RandomStream random = view.random(SimulationUse::kCeilingNoise);
  const Pose2 T_map_sensor = view.base_in_map() * parse_world_pose("mount", o.mount);
  const double scale = o.side_m / o.pixels;
  const double middle = 0.5 * (o.pixels - 1);
  CeilingPatch patch{view.stamp, o.pixels, o.pixels, scale, {}};
  const auto pixels = static_cast<std::uint32_t>(o.pixels) * static_cast<std::uint32_t>(o.pixels);
  const double exposure = 1.0 + o.sigma_exposure * random.normal4(pixels)[0];
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const int row = static_cast<int>(i) / o.pixels, column = static_cast<int>(i) % o.pixels;
    const Point2 seen = T_map_sensor * Point2{scale * (middle - row), scale * (middle - column)};
    const double gray = exposure * ceiling_gray(ceiling, seen) + o.sigma_gray * random.normal4(i)[0];
    patch.gray.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(gray, 0.0, 255.0))));
  }
  return patch;
}

}  // namespace cairn
