#pragma once

#include "apps/cairn/campaign_file.hpp"
#include "apps/cairn/process_pool.hpp"
#include "cairn/eval/cell_result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::app {

/// The recording of a cell: given, or simulated before.
struct CellRecording {
  std::string log;
  std::string map;
  std::string reference;
  std::vector<std::string> simulate;  ///< arguments of `cairn simulate` without --out; empty for a given one
  std::string file;                   ///< name that the simulation writes to, within its folder
  std::string id;  ///< fingerprint of `simulate` and the world's file; empty for a given one
};

/// Names of the files in the folder of a simulated recording.
inline constexpr const char* kSimulatedLog = "world.log";
inline constexpr const char* kSimulatedSensors = "world.mcap";  ///< of task sensors
inline constexpr const char* kSimulatedMap = "world.map.yaml";
inline constexpr const char* kSimulatedTruth = "world.truth.tum";

/// @param logs  folder of the simulated recordings
CellRecording recording_of(const Campaign& campaign, const CampaignCell& cell,
                           const std::filesystem::path& logs);

/// Arguments of the program that runs the cell ("localize", "--map", ...; or "log", "noise", ...), without
/// `--out`.
std::vector<std::string> cell_arguments(const Campaign& campaign, const CampaignCell& cell,
                                        const CellRecording& recording);

/// Fingerprint of a cell: 16 hexadecimal digits of its names, its arguments, and what the files it reads hold
/// (of one above 1 MiB: its size and both ends). The same on every machine as long as the paths in the
/// campaign file are.
std::string cell_id(const Campaign& campaign, const CampaignCell& cell, const CellRecording& recording);

/// Reads the folder of the finished run, and what the process used.
CellResult read_cell(const Campaign& campaign, const CampaignCell& cell, const std::filesystem::path& run,
                     const JobEnd& end);

}  // namespace cairn::app
