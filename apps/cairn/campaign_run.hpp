#pragma once

#include "apps/cairn/campaign_cell.hpp"
#include "apps/cairn/campaign_file.hpp"
#include "apps/cairn/campaign_folder.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cairn::app {

struct CampaignRunOptions {
  int jobs = 1;           ///< processes at a time
  std::size_t first = 0;  ///< cells first..last are run
  std::size_t last = 0;
};

struct CampaignFailure {
  std::string command;
  std::string reason;  ///< the last line that the command printed, or how it ended
};

struct CampaignOutcome {
  std::size_t skipped = 0;  ///< finished before
  std::size_t ran = 0;
  std::vector<CampaignFailure> failures;
  bool interrupted = false;
};

/// Simulates what is to be simulated and runs the cells that are not finished, each as a process of its own.
/// A cell whose run ends lost (exit code 4) is a result; one that ends otherwise is a failure, and the others
/// go on.
CampaignOutcome run_campaign(const CampaignFile& file, const CampaignFolder& folder,
                             const CampaignRunOptions& options);

/// The finished cells, in the order of the campaign.
std::vector<CellResult> gather_results(const CampaignFile& file, const CampaignFolder& folder);

}  // namespace cairn::app
