#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/io/gray_image.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <filesystem>
#include <istream>
#include <string>

namespace cairn {

/// The YAML file beside a map picture, as map_server of ROS 1 and nav2 write it.
struct MapDescription {
  /// What a pixel says. With p = its darkness 0..1 (its lightness if `negate`):
  enum class Mode {
    kTrinary,  ///< 100 % above the occupied threshold, 0 % below the free one, unknown between
    kScale,    ///< percent occupied = 100 p, kept off the thresholds by rounding (map_server stretches the
               ///< range between the thresholds instead: the states are the same)
    kRaw       ///< the stored number 0..100 is the percentage, others are unknown; `negate` does not apply
  };

  std::string image;  ///< path, relative to the YAML file's folder
  double resolution_m = 0.0;
  Pose2 T_map_grid;  ///< `origin`: outer corner of the lower left pixel, and yaw
  bool negate = false;
  OccupancyGrid::Thresholds thresholds;  ///< nav2's defaults where the file names none
  Mode mode = Mode::kTrinary;
  /// Beyond map_server: files with the same place as normal distributions and as walls (read_map_set), in the
  /// same frame, relative to the YAML file's folder; empty: none.
  std::string ndt, walls;
};

/// Reads the YAML text. `image`, `resolution` and `origin` must be there; an unknown key is counted as a
/// warning, and so is a resolution beyond 1 m ("implausible units": centimetres look like this).
/// @throws InputError file:line:column for text that is not YAML, a missing key, a value of another kind,
///   NaN, a resolution outside 0.0001..100 m, an origin beyond 1e8 m, thresholds not 0 <= free <= occupied <=
///   1
MapDescription read_map_description(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// The picture's top row is the grid's last one. A pixel that is not opaque is unknown (in kRaw opacity is
/// ignored).
/// @throws InputError if the picture is larger than kMaxCells
OccupancyGrid to_grid(const GrayImage& image, const MapDescription& description);

/// Picture of a grid, in map_saver's greys: occupied 0..89, free 206..254, unknown 205 (90..205 for a
/// probability between the thresholds). Within each class darker is more probably occupied, to 1/255. Read
/// back as kTrinary with the thresholds 0.65 and 0.196, every state is the same.
GrayImage to_image(const OccupancyGrid& grid);

/// Writes `path` (YAML, trinary) and the picture beside it, named alike: PNG, or PGM if asked.
/// @throws InputError if one cannot be written
enum class MapImageFormat { kPng, kPgm };
void write_map(const std::filesystem::path& path, const OccupancyGrid& grid,
               MapImageFormat format = MapImageFormat::kPng);

}  // namespace cairn
