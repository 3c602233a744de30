#include "cairn/io/map_yaml.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/option_suggestion.hpp"
#include "cairn/io/pose_collector.hpp"
#include "cairn/io/yaml_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <yaml-cpp/yaml.h>

namespace cairn {
namespace {

constexpr double kMinResolutionM = 1e-4;
constexpr double kMaxResolutionM = 100.0;
constexpr double kCoarsestPlausibleM = 1.0;
constexpr std::array<const char*, 9> kKeys = {
    "image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode", "ndt", "walls"};

/// Typed access to the keys of one YAML file, with its places for messages.
class MapYaml {
 public:
  MapYaml(const YAML::Node& root, std::string name) : root_(root), name_(std::move(name)) {
    if (!root_.IsMap())
      fail(root_, "is not a map description (key: value lines)", "name the map's .yaml file");
  }

  bool has(const char* key) const { return root_[key].IsDefined(); }

  YAML::Node require(const char* key) const {
    if (!has(key)) {
      throw InputError(name_, std::string("has no key '") + key + "'",
                       "a map needs image, resolution and origin");
    }
    return root_[key];
  }

  std::string text(const YAML::Node& node, const char* key) const {
    if (!node.IsScalar() || node.Scalar().empty()) fail(node, std::string(key) + " is not a word", "");
    return node.Scalar();
  }

  double number(const YAML::Node& node, const char* key, double min, double max) const {
    double value = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value)) {
      fail(node, std::string(key) + " is not a number", "");
    }
    if (!(value >= min && value <= max)) {
      fail(node, std::string(key) + " is not within " + short_text(min) + ".." + short_text(max), "");
    }
    return value;
  }

  void warn_of_unknown_keys(Diagnostics& diagnostics) const {
    for (const auto& entry : root_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "(not a word)";
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
        diagnostics.warn("unknown key", where(entry.first), "'" + key + "' has no meaning here");
      }
    }
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& what, const std::string& remedy) const {
    throw InputError(where(node), what, remedy);
  }

 private:
  std::string where(const YAML::Node& node) const {
    return name_ + ":" + std::to_string(node.Mark().line + 1) + ":" + std::to_string(node.Mark().column + 1);
  }

  static std::string short_text(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  YAML::Node root_;
  std::string name_;
};

Pose2 read_origin(const MapYaml& yaml) {
  const YAML::Node origin = yaml.require("origin");
  if (!origin.IsSequence() || origin.size() != 3)
    yaml.fail(origin, "origin is not [x, y, yaw]", "give m, m, rad");
  return {yaml.number(origin[0], "origin x", -kMaxCoordinateM, kMaxCoordinateM),
          yaml.number(origin[1], "origin y", -kMaxCoordinateM, kMaxCoordinateM),
          normalize_angle(yaml.number(origin[2], "origin yaw", -1e3, 1e3))};
}

bool read_negate(const MapYaml& yaml) {
  const YAML::Node node = yaml.require("negate");
  bool flag = false;
  if (node.IsScalar() && YAML::convert<bool>::decode(node, flag))
    return flag;  // nav2 writes 0, some write false
  const double value = yaml.number(node, "negate", 0.0, 1.0);
  if (value != 0.0 && value != 1.0) yaml.fail(node, "negate is neither 0 nor 1", "");
  return value == 1.0;
}

MapDescription::Mode read_mode(const MapYaml& yaml) {
  const YAML::Node node = yaml.require("mode");
  const std::string mode = yaml.text(node, "mode");
  if (mode == "trinary") return MapDescription::Mode::kTrinary;
  if (mode == "scale") return MapDescription::Mode::kScale;
  if (mode == "raw") return MapDescription::Mode::kRaw;
  yaml.fail(node, "mode is not known", "use trinary, scale or raw");
}

MapDescription describe(const MapYaml& yaml) {
  MapDescription map;
  map.image = yaml.text(yaml.require("image"), "image");
  map.resolution_m = yaml.number(yaml.require("resolution"), "resolution", kMinResolutionM, kMaxResolutionM);
  map.T_map_grid = read_origin(yaml);
  if (yaml.has("negate")) map.negate = read_negate(yaml);
  if (yaml.has("mode")) map.mode = read_mode(yaml);
  if (yaml.has("ndt")) map.ndt = yaml.text(yaml.require("ndt"), "ndt");
  if (yaml.has("walls")) map.walls = yaml.text(yaml.require("walls"), "walls");
  auto& [occupied, free] = map.thresholds;
  if (yaml.has("occupied_thresh")) {
    occupied = yaml.number(yaml.require("occupied_thresh"), "occupied_thresh", 0.0, 1.0);
  }
  if (yaml.has("free_thresh")) free = yaml.number(yaml.require("free_thresh"), "free_thresh", 0.0, 1.0);
  if (free > occupied) yaml.fail(yaml.require("origin"), "free_thresh exceeds occupied_thresh", "swap them");
  return map;
}

// Rounded percentage on the same side of both thresholds as the probability itself.
int percent(double probability, const OccupancyGrid::Thresholds& thresholds) {
  const int rounded = static_cast<int>(std::lround(100.0 * probability));
  if (probability > thresholds.occupied && !(rounded / 100.0 > thresholds.occupied)) return rounded + 1;
  if (probability < thresholds.free && !(rounded / 100.0 < thresholds.free)) return rounded - 1;
  if (probability <= thresholds.occupied && rounded / 100.0 > thresholds.occupied) return rounded - 1;
  return probability >= thresholds.free && rounded / 100.0 < thresholds.free ? rounded + 1 : rounded;
}

int cell_of_gray(int gray, const MapDescription& map) {
  if (map.mode == MapDescription::Mode::kRaw) return gray <= 100 ? gray : OccupancyGrid::kUnknown;
  const double probability = (map.negate ? gray : 255 - gray) / 255.0;
  if (map.mode == MapDescription::Mode::kScale)
    return std::clamp(percent(probability, map.thresholds), 0, 100);
  if (probability > map.thresholds.occupied) return 100;
  return probability < map.thresholds.free ? 0 : OccupancyGrid::kUnknown;
}

std::array<OccupancyGrid::Cell, 256> cell_table(const MapDescription& map) {
  std::array<OccupancyGrid::Cell, 256> cells{};
  for (int gray = 0; gray < 256; ++gray) {
    cells[static_cast<std::size_t>(gray)] = static_cast<OccupancyGrid::Cell>(cell_of_gray(gray, map));
  }
  return cells;
}

}  // namespace

MapDescription read_map_description(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  try {
    const MapYaml yaml(load_yaml(input), name);
    yaml.warn_of_unknown_keys(diagnostics);
    MapDescription map = describe(yaml);
    if (map.resolution_m > kCoarsestPlausibleM) {
      diagnostics.warn("implausible units", name, "a resolution beyond 1 m; metres per pixel are expected");
    }
    return map;
  } catch (const YAML::Exception& error) {
    throw InputError(
        name + ":" + std::to_string(error.mark.line + 1) + ":" + std::to_string(error.mark.column + 1),
        "is not YAML: " + printable(error.msg), "name the map's .yaml file");
  }
}

OccupancyGrid to_grid(const GrayImage& image, const MapDescription& map) {
  if (image.size() > kMaxCells) throw InputError(map.image, "has too many pixels", "use a coarser map");
  CAIRN_ASSERT(image.gray.size() == image.size());
  const GridGeometry geometry{image.width, image.height, map.resolution_m, map.T_map_grid};
  const auto table = cell_table(map);
  const bool has_opacity = !image.opacity.empty() && map.mode != MapDescription::Mode::kRaw;
  std::vector<OccupancyGrid::Cell> cells(image.size());
  for (int row = 0; row < image.height; ++row) {
    const std::size_t from = geometry.index(0, image.height - 1 - row);
    const std::size_t to = geometry.index(0, row);
    for (std::size_t column = 0; column < static_cast<std::size_t>(image.width); ++column) {
      const bool is_clear = has_opacity && image.opacity[from + column] < 255;
      cells[to + column] = is_clear ? OccupancyGrid::kUnknown : table[image.gray[from + column]];
    }
  }
  return OccupancyGrid(geometry, std::move(cells), map.thresholds);
}

}  // namespace cairn
