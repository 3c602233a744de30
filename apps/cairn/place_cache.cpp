#include "apps/cairn/place_cache.hpp"

#include "apps/cairn/fingerprint.hpp"
#include "apps/cairn/progress.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/maps/checksum.hpp"
#include "cairn/models/search/place_sampler.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;
constexpr const char* kFormat = "cairn places 1\n";
constexpr int kProgressSteps = 1000;

std::string key_of(const OccupancyGrid& map, const SignatureShape& shape, const PlaceIndexOptions& options) {
  return fmt::format("{:016x} {:a} {:a} {:a} {:a} {} {} {}", checksum(map), shape.first_bearing_rad,
                     shape.last_bearing_rad, shape.max_range_m, options.spacing_m, options.headings,
                     options.most_places, SignatureShape::kSectors);
}

std::string fingerprint_of(const std::string& text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fingerprint.text();
}

// Format, key, fingerprint of the numbers, then the numbers as they lie in memory (the format is of this
// machine's kind).
std::string packed(const std::string& key, const std::vector<ScanSignature>& signatures) {
  std::string numbers(signatures.size() * sizeof(ScanSignature), '\0');
  if (!numbers.empty()) std::memcpy(numbers.data(), signatures.data(), numbers.size());
  return kFormat + key + "\n" + fingerprint_of(numbers) + "\n" + numbers;
}

std::string next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  if (end == std::string_view::npos) return {};
  std::string line(rest.substr(0, end));
  rest.remove_prefix(end + 1);
  return line;
}

/// Why a file does not serve; empty: it does, and `signatures` holds its numbers.
std::string unpack_places(std::string_view bytes, const std::string& key, std::size_t places,
                          std::vector<ScanSignature>& signatures) {
  if (bytes.substr(0, std::strlen(kFormat)) != kFormat) return "is no index of places";
  bytes.remove_prefix(std::strlen(kFormat));
  if (next_line(bytes) != key) return "belongs to another map or sensor";
  const std::string told = next_line(bytes);
  if (bytes.size() != places * sizeof(ScanSignature) || fingerprint_of(std::string(bytes)) != told)
    return "is damaged";
  signatures.resize(places);
  std::memcpy(signatures.data(), bytes.data(), bytes.size());
  return {};
}

std::optional<std::string> content_of(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;  // reading a folder would throw
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

void keep(const fs::path& path, const std::string& bytes) {
  try {
    write_file(path, bytes);
  } catch (const InputError& error) {
    spdlog::info("the index of places is not kept for the next time: {}", error.what());
  }
}

const LaserScan* first_scan(const Log& log, StreamId stream) {
  for (const Event& event : log.events) {
    if (event.stream == stream) return std::get<std::shared_ptr<const LaserScan>>(event.payload).get();
  }
  return nullptr;
}

bool in_use(const LocalizerOptions& options, const StreamInfo& stream) {
  if (stream.kind != StreamKind::kLaserScan) return false;
  const auto configured = options.streams.find(stream.name);
  return configured == options.streams.end() ? options.streams.empty() : configured->second.use;
}

}  // namespace

fs::path place_cache_path(const fs::path& map_path, const OccupancyGrid& map, const SignatureShape& shape,
                          const PlaceIndexOptions& options) {
  return map_path.string() + ".places-" + fingerprint_of(key_of(map, shape, options));
}

std::shared_ptr<const PlaceIndex> cached_places(const fs::path& map_path, const OccupancyGrid& map,
                                                const SignatureShape& shape,
                                                const PlaceIndexOptions& options) {
  const std::string key = key_of(map, shape, options);
  const fs::path path = place_cache_path(map_path, map, shape, options);
  if (const auto bytes = content_of(path)) {
    std::vector<ScanSignature> signatures;
    const std::string wrong = unpack_places(*bytes, key, PlaceIndex::places_on(map, options), signatures);
    if (wrong.empty()) return std::make_shared<const PlaceIndex>(map, shape, options, std::move(signatures));
    spdlog::warn("{}: {}; it is made again", path.string(), wrong);
  }
  Progress progress("looking around in the map", kProgressSteps);
  auto index = std::make_shared<const PlaceIndex>(map, shape, options, [&](double done) {
    progress.update(static_cast<std::int64_t>(kProgressSteps * done));
  });
  keep(path, packed(key, index->signatures()));
  return index;
}

PlaceIndices places_for(const Log& log, const LocalizerOptions& options, const MapSet& maps,
                        const StreamMaps& stream_maps, const std::string& map_path) {
  PlaceIndices places;
  if (!samples_from_measurements(options.recipe)) return places;
  for (std::size_t i = 0; i < log.streams.size(); ++i) {
    const auto id = static_cast<StreamId>(i);
    const StreamInfo& stream = log.streams[i];
    const LaserScan* scan = in_use(options, stream) ? first_scan(log, id) : nullptr;
    if (scan == nullptr) continue;
    const auto configured = options.streams.find(stream.name);
    const std::string own = configured == options.streams.end() ? "" : configured->second.map;
    const auto known = stream_maps.find(own);
    const bool main = own.empty() || known == stream_maps.end();
    places[stream.name] = cached_places(main ? map_path : own, main ? *maps.grid() : *known->second,
                                        PlaceSampler::shape_of(*scan), {});
  }
  return places;
}

}  // namespace cairn::app
