#pragma once

#include "cairn/eval/score.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Where and how wrong a run was, thinned out, for pictures of many runs at once.
struct ErrorTrace {
  std::vector<double> t_s;  ///< since the first judged pose
  std::vector<double> x_m;  ///< of the reference
  std::vector<double> y_m;
  std::vector<double> error_m;
};

/// What one cell of a campaign measured.
struct CellResult {
  std::string id;  ///< fingerprint of everything that determines the cell
  std::string input;
  std::string recipe;
  std::string parameters;
  std::string variant;
  std::uint64_t seed = 0;
  std::string program;  ///< version and fingerprint of the program that ran it
  std::string command;  ///< that runs it again
  /// By name with its unit; a figure that the run does not have is missing. See docs/campaigns.md.
  std::map<std::string, double> metrics;
  ErrorTrace trace;
  /// Evenly spread quantiles of the errors of sensors, by name (m, rad); see docs/campaigns.md.
  std::map<std::string, std::vector<double>> distributions;
};

/// One line of JSON. Numbers keep all their digits; one that is not finite is left out.
std::string to_json(const CellResult& result);

/// @throws InputError naming `where` for a text that to_json did not write
CellResult cell_result_from_json(std::string_view text, const std::string& where);

/// Accuracy as metrics of a cell, and its trace of at most 400 points: ate_mean_m, ate_rmse_m, ate_median_m,
/// ate_p95_m, ate_max_m, final_error_m (of the last pose), heading_mean_rad, rpe_translation_m and
/// rpe_rotation_rad (rms), coverage, bad_share (beyond 1 m or 45 degrees), lost (0 or 1), converged_s: after
/// which the error stays below 1 m and 45 degrees for at least 10 s or to the end (missing if that never
/// happens).
void add_accuracy(const Score& score, const Trajectory& reference, CellResult& result);

}  // namespace cairn
