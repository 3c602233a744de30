#include "cairn/eval/lost.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

namespace cairn {

void LostOptions::validate() const {
  const auto require = [](bool holds, const char* key, const char* remedy) {
    if (!holds) throw ConfigurationError(key, "is out of range", remedy);
  };
  require(position_m > 0.0, "lost.position_m", "give metres greater than 0");
  require(heading_rad > 0.0, "lost.heading_rad", "give radians greater than 0");
  require(final_window_s >= 0.0 && final_window_s < 9e9, "lost.final_window_s", "give seconds, 0 or more");
  require(max_bad_share >= 0.0 && max_bad_share <= 1.0, "lost.max_bad_share", "give a share from 0 to 1");
}

LostVerdict judge_lost(std::span<const PoseError> errors, const LostOptions& options) {
  options.validate();
  if (errors.empty()) return {};
  const Time window_start = errors.back().stamp - duration_from_seconds(options.final_window_s);
  std::size_t bad = 0, in_window = 0, bad_in_window = 0;
  for (const PoseError& error : errors) {
    const bool is_bad =
        error.position_m > options.position_m || std::abs(error.heading_rad) > options.heading_rad;
    const bool is_final = error.stamp >= window_start;
    bad += is_bad;
    in_window += is_final;
    bad_in_window += is_bad && is_final;
  }
  LostVerdict verdict;
  verdict.bad_share = static_cast<double>(bad) / static_cast<double>(errors.size());
  verdict.ends_lost = 2 * bad_in_window >= in_window;
  verdict.lost = verdict.ends_lost || verdict.bad_share > options.max_bad_share;
  return verdict;
}

}  // namespace cairn
