#pragma once

#include "cairn/eval/campaign_tables.hpp"

#include <string>

namespace cairn {

/// Tables of task sensors, as Markdown: for each input every figure of the real log beside that of the
/// simulated ones (mean, and the range over the seeds), and how far the distributions of the errors are
/// apart.
std::string sensor_tables(const CampaignReport& report);

}  // namespace cairn
