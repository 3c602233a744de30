#pragma once

#include "cairn/models/sensor/beam_model.hpp"

#include <span>
#include <vector>

namespace cairn {

/// A reading and what the map says from where the robot was.
struct BeamSample {
  double z_m = 0.0;         ///< measured; the largest range or more for a reading without return
  double expected_m = 0.0;  ///< range of the map, to an occupied cell; 1e9 where there is none
};

struct BeamEmLimits {
  int max_iterations = 300;
  double tolerance = 1e-6;  ///< stops when the mean log-likelihood grows by less, nat per beam
};

struct BeamEmStep {
  double mean_log_likelihood = 0.0;  ///< nat per beam, with `options`
  BeamModelOptions options;
};

struct BeamEmResult {
  std::vector<BeamEmStep> steps;  ///< the start, then one per iteration; the log-likelihood never falls
  bool converged = false;
  const BeamModelOptions& options() const { return steps.back().options; }
};

/// Mean log-likelihood of a beam, nat. @pre samples not empty
double mean_log_likelihood(std::span<const BeamSample> samples, double max_range_m,
                           const BeamModelOptions& options);

/// Learns the six parameters of the beam mixture by expectation maximisation (Thrun et al., Probabilistic
/// Robotics, table 6.2); `max_beams` and `effective_beams` stay. Unlike the book, which forgets that short
/// readings end at the wall and that noise may carry a reading out of reach, both steps are those of the
/// mixture itself (BeamMixture), so that no iteration lowers the likelihood.
/// @throws InputError without samples, or with one that is not finite or negative
BeamEmResult learn_beam_model(std::span<const BeamSample> samples, double max_range_m,
                              const BeamModelOptions& start, const BeamEmLimits& limits = {});

}  // namespace cairn
