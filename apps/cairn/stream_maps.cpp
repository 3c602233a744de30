#include "apps/cairn/stream_maps.hpp"

#include "cairn/io/map_reader.hpp"
#include "cairn/maps/checksum.hpp"

#include <filesystem>

namespace cairn::app {

void make_stream_maps_absolute(LocalizerOptions& options) {
  for (auto& [name, stream] : options.streams) {
    if (!stream.map.empty()) stream.map = std::filesystem::absolute(stream.map).lexically_normal();
  }
}

StreamMaps read_stream_maps(const LocalizerOptions& options, Diagnostics& diagnostics) {
  StreamMaps maps;
  for (const auto& [name, stream] : options.streams) {
    if (!stream.map.empty() && !maps.contains(stream.map)) {
      maps[stream.map] = read_map(stream.map, diagnostics);
    }
  }
  return maps;
}

std::map<std::string, std::uint64_t> checksums(const StreamMaps& maps) {
  std::map<std::string, std::uint64_t> sums;
  for (const auto& [name, map] : maps) sums[name] = checksum(*map);
  return sums;
}

}  // namespace cairn::app
