#pragma once

#include "cairn/eval/association.hpp"

#include <span>
#include <vector>

namespace cairn {

/// Error of one estimate.
struct PoseError {
  Time stamp;
  double position_m = 0.0;   ///< distance of the positions
  double heading_rad = 0.0;  ///< estimate minus reference, in [-pi, pi)
};

/// Figures of a sample of non-negative numbers; all 0 for an empty one.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< of the sample (n - 1); 0 for one value
  double rms = 0.0;
  double median = 0.0;
  double p95 = 0.0;  ///< 95 % lie at or below: linear between the two nearest ranks
  double max = 0.0;
};

Summary summarize(std::vector<double> values);

/// Absolute trajectory error: how far the estimate is from the reference, sample by sample (Sturm et al.,
/// IROS 2012, with position errors in the plane).
struct Ate {
  Summary position_m;
  Summary heading_rad;            ///< of the absolute values
  std::vector<PoseError> errors;  ///< in the order of the pairs
};

Ate absolute_trajectory_error(std::span<const PosePair> pairs);

}  // namespace cairn
