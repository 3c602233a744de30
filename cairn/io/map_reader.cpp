#include "cairn/io/map_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/gray_image.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/wean_map.hpp"

namespace cairn {
namespace {

constexpr std::size_t kFirstBytes = 32;
constexpr std::size_t kMaxYamlBytes = 1 << 20;

std::string first_bytes(std::istream& input) {
  std::string bytes(kFirstBytes, '\0');
  input.read(bytes.data(), kFirstBytes);
  bytes.resize(static_cast<std::size_t>(input.gcount()));
  input.clear();
  input.seekg(0);
  return bytes;
}

std::size_t size_of(std::istream& input) {
  input.seekg(0, std::ios::end);
  const auto size = static_cast<std::size_t>(input.tellg());
  input.seekg(0);
  return size;
}

OccupancyGrid read_yaml_map(std::istream& input, const std::filesystem::path& path,
                            Diagnostics& diagnostics) {
  if (size_of(input) > kMaxYamlBytes) {
    throw InputError(path.string(), "is no known map format", "name the map's .yaml file");
  }
  const MapDescription map = read_map_description(input, path.string(), diagnostics);
  const std::filesystem::path picture =
      path.parent_path() / map.image;  // an absolute image path stays as it is
  return to_grid(read_image(*open_input(picture), picture.string()), map);
}

}  // namespace

std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const auto input = open_input(path);
  const std::string start = first_bytes(*input);
  if (looks_like_image(start)) {
    throw InputError(path.string(), "is a bare picture without scale and place", "name the map's .yaml file");
  }
  if (looks_like_wean_map(start)) {
    return std::make_shared<const OccupancyGrid>(read_wean_map(*input, path.string()));
  }
  return std::make_shared<const OccupancyGrid>(read_yaml_map(*input, path, diagnostics));
}

std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  return read_map(path, diagnostics);
}

}  // namespace cairn
