#include "apps/cairn/replay_run.hpp"

#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/maps/checksum.hpp"

#include <algorithm>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

LocalizerOptions read_options(const fs::path& file, const std::string& configuration) {
  LocalizerOptions options;
  Diagnostics diagnostics;
  std::istringstream input(configuration);
  read_configuration(
      input, file.string() + " (configuration)", [&](OptionVisitor& visitor) { options.visit(visitor); },
      diagnostics);
  options.validate();
  return options;
}

void check_same_map(const std::string& path, std::uint64_t found, std::uint64_t wanted, const char* hint) {
  if (found == wanted) return;
  throw InputError(
      path,
      fmt::format("is not the map of the recorded run: its checksum is {:016x}, that of the run's map was "
                  "{:016x}",
                  found, wanted),
      hint);
}

std::shared_ptr<const MapSet> read_same_map(const std::string& path, std::uint64_t wanted) {
  Diagnostics diagnostics;
  auto maps = read_map_set(path, diagnostics);
  check_same_map(path, checksum(*maps), wanted, "name the map as it was then with --map");
  return maps;
}

// Maps that the recorded run did not use, with other options, are as they are.
StreamMaps read_same_stream_maps(const LocalizerOptions& options, const RunHeader& header) {
  Diagnostics diagnostics;
  StreamMaps maps = read_stream_maps(options, diagnostics);
  for (const auto& [path, found] : checksums(maps)) {
    const auto recorded = header.stream_map_checksums.find(path);
    if (recorded == header.stream_map_checksums.end()) continue;
    check_same_map(
        path, found, recorded->second,
        "put the map of that run back there, or name its place with --what-if streams.NAME.map=...");
  }
  return maps;
}

}  // namespace

RecordedRun read_recorded_run(const fs::path& run, const std::string& map) {
  RecordedRun result;
  result.file = fs::is_directory(run) ? find_recording(run) : run;
  result.recording = read_recording(result.file);
  const RunHeader& header = result.recording.header;
  result.options = read_options(result.file, header.configuration);
  result.maps = read_same_map(map.empty() ? header.map_path : map, header.map_checksum);
  result.map = result.maps->grid();
  return result;
}

LocalizeResult run_again(const RecordedRun& run, const LocalizerOptions& options, int threads) {
  return localize({.log = &run.recording.log,
                   .map = run.map,
                   .maps = run.maps,
                   .stream_maps = read_same_stream_maps(options, run.recording.header),
                   .options = options,
                   .start = {run.recording.header.T_map_base},
                   .seed = run.recording.header.seed,
                   .threads = threads,
                   .live = run.recording.header.live});
}

std::optional<Parting> first_parting(const Recording& recorded, const std::vector<Estimate>& replayed) {
  const std::size_t common = std::min(recorded.estimates.size(), replayed.size());
  for (std::size_t i = 0; i < common; ++i) {
    const auto difference = exact::first_difference(recorded.estimates[i], replayed[i]);
    if (difference) return Parting{i, recorded.estimates[i].stamp, *difference};
  }
  if (recorded.estimates.size() > common) {
    return Parting{common, recorded.estimates[common].stamp, {"estimate", "there is one", "there is none"}};
  }
  if (replayed.size() > common && recorded.finished) {
    return Parting{common, replayed[common].stamp, {"estimate", "there is none", "there is one"}};
  }
  return std::nullopt;
}

}  // namespace cairn::app
