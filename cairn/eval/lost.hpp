#pragma once

#include "cairn/eval/ate.hpp"

#include <numbers>
#include <span>

namespace cairn {

/// When a run counts as lost. A sample is *bad* if its position error exceeds `position_m` or its heading
/// error exceeds `heading_rad`. The run is lost if
///   - it ends lost: at least half of the samples within `final_window_s` of the last one are bad, or
///   - it was lost too long: more than `max_bad_share` of all samples are bad, or
///   - there are no samples at all: an estimate that covers nothing has found nothing.
struct LostOptions {
  double position_m = 1.0;
  double heading_rad = std::numbers::pi / 4.0;
  double final_window_s = 5.0;
  double max_bad_share = 0.10;

  /// @throws ConfigurationError for limits that are not positive or a share outside 0..1.
  void validate() const;
};

struct LostVerdict {
  bool lost = true;
  bool ends_lost = true;
  double bad_share = 1.0;  ///< of all samples
};

/// @param errors in the order of their stamps, as absolute_trajectory_error() gives them
LostVerdict judge_lost(std::span<const PoseError> errors, const LostOptions& options = {});

}  // namespace cairn
