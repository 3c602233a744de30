#pragma once

#include "apps/cairn/localize_run.hpp"
#include "cairn/io/estimate_message.hpp"
#include "cairn/io/recording.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cairn::app {

/// A recorded run and what it ran with.
struct RecordedRun {
  std::filesystem::path file;
  Recording recording;
  std::shared_ptr<const MapSet> maps;
  std::shared_ptr<const OccupancyGrid> map;  ///< the grid of `maps`
  LocalizerOptions options;
};

/// @param run  the folder of a run, or the file of its recording
/// @param map  where the map is now; empty: where it was
/// @throws InputError if there is no recording, or the map is not to the last cell that of the run
RecordedRun read_recorded_run(const std::filesystem::path& run, const std::string& map);

/// Runs the recorded events again.
/// @throws InputError if a map of a single stream is not to the last cell that of the run (it is named)
LocalizeResult run_again(const RecordedRun& run, const LocalizerOptions& options, int threads);

/// Where two runs of the same events part.
struct Parting {
  std::size_t number = 0;  ///< of the estimate, from 0
  Time stamp;              ///< of the recorded one (of the other, where there is none)
  exact::Difference difference;
};

/// The first estimate that is not the same to the last bit; nullopt if all are. A run that did not finish may
/// lack estimates at its end.
std::optional<Parting> first_parting(const Recording& recorded, const std::vector<Estimate>& replayed);

}  // namespace cairn::app
