#pragma once

#include "cairn/eval/campaign.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::app {

/// A campaign that can be run: every file that it names is there, every setting is known.
struct CampaignFile {
  std::filesystem::path path;
  Campaign campaign;  ///< with all paths absolute, or relative to the current folder
  std::vector<CampaignCell> cells;
};

/// Reads a campaign. Relative paths count from the campaign's folder; `$CAIRN_DATA` at the beginning of a
/// path is replaced by the environment variable.
/// @throws ConfigurationError file:line:column: key, for what the campaign or a setting says wrong;
/// InputError for a
///   file that is not there
CampaignFile read_campaign(const std::filesystem::path& path);

/// The settings of a cell: those of the input, then the recipe, then those of the parameters.
/// Input and parameters cannot both name a configuration file (read_campaign refuses that).
struct CellSettings {
  std::string config;
  std::vector<std::string> set;
};
CellSettings settings_of(const Campaign& campaign, const CampaignCell& cell);

}  // namespace cairn::app
