#pragma once

#include "apps/cairn/localize_run.hpp"
#include "cairn/core/trajectory.hpp"

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace cairn::app {

/// What a result cannot know of its run.
struct RunContext {
  std::string log_path;
  std::string map_path;
  std::uint64_t seed = 1;
  int threads = 1;
  double read_s = 0.0;
  bool live = false;
};

struct RunSummary {
  nlohmann::json metrics;  ///< metrics.json
  std::string text;        ///< a few lines for a person
  bool lost = true;        ///< by the reference where there is one, else by the belief itself (judge_end)
  std::string reason;
};

RunSummary summarize_run(const RunContext& context, const Log& log, const OccupancyGrid& map,
                         const LocalizerOptions& options, const std::optional<Trajectory>& reference,
                         const Diagnostics& input_diagnostics, const LocalizeResult& result);

}  // namespace cairn::app
