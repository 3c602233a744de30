#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace cairn::app {

/// What `cairn localize --out DIR` leaves behind, file by file.
struct RunData {
  Trajectory trajectory;                       ///< trajectory.tum: T_map_base
  std::vector<Estimate> estimates;             ///< estimate.csv: one row per estimate (LocalizeResult)
  nlohmann::json metrics;                      ///< metrics.json: an object with at least "cairn_version"
  std::string configuration;                   ///< config.yaml: the effective configuration
  std::shared_ptr<const OccupancyGrid> map;    ///< map.yaml and map.png; may be absent (null)
  std::vector<HypothesisSnapshot> hypotheses;  ///< hypotheses.csv; may be empty
  std::vector<ParticleSnapshot> particles;     ///< particles.csv; may be empty
  std::optional<Trajectory> reference;         ///< reference.tum; absent without a reference
  bool recorded = false;                       ///< run.mcap: write_run finds it where prepare_recording said
};

/// Refuses an existing DIR that is not empty and holds no earlier run (a metrics.json of Cairn), and a DIR
/// that is a file. Call it before the work begins: nobody should lose their files, or an hour, to a slip in
/// `--out`.
/// @throws ConfigurationError
void check_run_directory(const std::filesystem::path& directory);

/// Makes DIR ready for a run that writes its recording while it goes on, and returns where to: a place within
/// DIR/.writing, so that an earlier run stays whole until write_run replaces it.
/// @throws ConfigurationError as check_run_directory; InputError where the disk refuses.
std::filesystem::path prepare_recording(const std::filesystem::path& directory);

/// The recording of a run: DIR/run.mcap; if there is none, that of a run which was killed while it wrote.
/// @throws InputError if there is neither
std::filesystem::path find_recording(const std::filesystem::path& directory);

/// Writes all files, replacing those of an earlier run (its optional files and report.html go away).
/// Everything is first written to DIR/.writing and then renamed, metrics.json last: a run cut short in
/// between is either the old one or refuses to be read, never a mixture.
/// @throws ConfigurationError as check_run_directory; InputError where the disk refuses.
void write_run(const std::filesystem::path& directory, const RunData& run);

/// @throws InputError that names the file (and line) that is missing or damaged, and what to do.
RunData read_run(const std::filesystem::path& directory);

/// Whole content of one file of a run.
/// @throws InputError if it is missing or cannot be read
std::string read_file(const std::filesystem::path& path);

/// Writes one file of a run by way of a temporary name.
/// @throws InputError where the disk refuses.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace cairn::app
