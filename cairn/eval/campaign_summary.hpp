#pragma once

#include "cairn/eval/bootstrap.hpp"
#include "cairn/eval/cell_result.hpp"
#include "cairn/eval/paired_comparison.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace cairn {

/// All seeds of one variant on one input.
struct CampaignGroup {
  std::string input;
  std::string variant;
  std::size_t cells = 0;
  std::map<std::string, MeanInterval> metrics;  ///< over the cells that have the metric
  std::map<std::string, double> smallest;       ///< of the cells
  std::map<std::string, double> median;
  std::map<std::string, double> largest;
};

/// One variant against the baseline in one metric, on the cells that both have: same input, same seed.
struct CampaignComparison {
  static constexpr const char* kAllInputs = "all inputs";

  std::string input;  ///< or kAllInputs, where there are several
  std::string variant;
  std::string baseline;
  std::string metric;
  PairedComparison paired;
};

struct CampaignSummary {
  std::vector<CampaignGroup> groups;            ///< in the order in which input and variant first occur
  std::vector<CampaignComparison> comparisons;  ///< of every metric that both have
};

/// @param baseline  a variant; if no result is of it there are no comparisons
CampaignSummary summarize_campaign(std::span<const CellResult> results, const std::string& baseline,
                                   const BootstrapOptions& options = {});

}  // namespace cairn
