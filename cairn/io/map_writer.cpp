#include "cairn/core/errors.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/pgm.hpp"
#include "cairn/io/png.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include <yaml-cpp/yaml.h>

namespace cairn {
namespace {

// map_saver's values. With these two thresholds grey 205 is unknown: p = 50/255 = 0.196078 > 0.196.
constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;
constexpr int kUnknownGray = 205;
constexpr int kDarkestFree = 206, kLightestFree = 254;
constexpr int kDarkestBetween = 90;
constexpr int kLightestOccupied = 89;

std::uint8_t gray_of(const OccupancyGrid& grid, std::size_t index) {
  const auto cell = grid.cells()[index];
  if (cell == OccupancyGrid::kUnknown) return kUnknownGray;
  const int gray = static_cast<int>(std::lround(2.55 * (100 - cell)));
  switch (grid.state(index)) {
    case CellState::kOccupied:
      return static_cast<std::uint8_t>(std::min(gray, kLightestOccupied));
    case CellState::kFree:
      return static_cast<std::uint8_t>(std::clamp(gray, kDarkestFree, kLightestFree));
    case CellState::kUnknown:
      break;
  }
  return static_cast<std::uint8_t>(std::clamp(gray, kDarkestBetween, kUnknownGray));
}

// The shortest text that reads back as the same number, whatever the locale.
std::string number_text(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), end.ptr);
}

std::string yaml_text(const std::string& image, const GridGeometry& geometry) {
  const Pose2& T = geometry.T_map_grid;
  YAML::Emitter quoted;
  quoted << image;
  return std::string("image: ") + quoted.c_str() +
         "\nmode: trinary\nresolution: " + number_text(geometry.resolution_m) + "\norigin: [" +
         number_text(T.x) + ", " + number_text(T.y) + ", " + number_text(T.theta) +
         "]\nnegate: 0\noccupied_thresh: " + number_text(kOccupiedThreshold) +
         "\nfree_thresh: " + number_text(kFreeThreshold) + "\n";
}

template <typename Write>
void write_file(const std::filesystem::path& path, Write write) {
  std::ofstream file(path, std::ios::binary);
  if (file) write(file);
  file.close();
  if (!file)
    throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
}

}  // namespace

GrayImage to_image(const OccupancyGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  GrayImage image{geometry.width, geometry.height, {}, {}};
  image.gray.reserve(image.size());
  for (int row = geometry.height - 1; row >= 0; --row) {
    for (int column = 0; column < geometry.width; ++column) {
      image.gray.push_back(gray_of(grid, geometry.index(column, row)));
    }
  }
  return image;
}

void write_map(const std::filesystem::path& path, const OccupancyGrid& grid, MapImageFormat format) {
  const bool as_png = format == MapImageFormat::kPng;
  std::filesystem::path picture = path;
  picture.replace_extension(as_png ? ".png" : ".pgm");
  if (picture == path) {
    throw InputError(path.string(), "is the name of a picture", "name the map's .yaml file");
  }
  const GrayImage image = to_image(grid);
  write_file(picture, [&](std::ostream& file) { as_png ? write_png(file, image) : write_pgm(file, image); });
  write_file(path,
             [&](std::ostream& file) { file << yaml_text(picture.filename().string(), grid.geometry()); });
}

}  // namespace cairn
