#pragma once

#include "cairn/eval/campaign.hpp"
#include "cairn/eval/campaign_summary.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Everything that a campaign's results are shown from.
struct CampaignReport {
  std::string title;
  std::string about;
  std::string baseline;
  bool sensors = false;              ///< of task sensors
  std::size_t cells = 0;             ///< that the campaign has
  std::vector<CellResult> results;   ///< of the finished ones, in the order of the cells
  std::vector<std::string> metrics;  ///< columns of the tables, in this order
  CampaignSummary summary;
};

/// Puts the results of a campaign together: sorts nothing, leaves out nothing.
CampaignReport make_campaign_report(const Campaign& campaign, std::vector<CellResult> results);

/// Tidy CSV: a header, then one row per cell and one column per variable (input, recipe, parameters, variant,
/// seed, then every metric that occurs, alphabetically). A missing value is an empty field; texts with
/// commas, quotes or line ends stand in quotes (RFC 4180).
std::string to_csv(const CampaignReport& report);

/// The groups and comparisons as JSON, for scripts; of the results the metrics but not the traces.
std::string to_json(const CampaignReport& report);

/// Tables for people, as Markdown: mean [95 % interval] of each metric per input and variant, and differences
/// to the baseline.
std::string to_markdown(const CampaignReport& report);

/// The self-contained page: `page` (the template that web/ builds) with the report in place of its mark
/// `<!--CAIRN:RUN-->`, in the way of render_report(). Besides the fields of to_json() it holds the traces.
/// @throws std::logic_error for a page without the mark
std::string render_campaign(std::string_view page, const CampaignReport& report);

}  // namespace cairn
