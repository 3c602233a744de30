#include "cairn/bayes/injections/injections.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

double likelihood_per_beam(double log_mean_likelihood, double effective_beams) {
  return std::exp(log_mean_likelihood / std::max(effective_beams, 1e-9));
}

void SensorResettingOptions::visit(OptionVisitor& v) {
  v.number({"threshold", "particles are replaced while the likelihood per beam is below this"}, threshold,
           {1e-6, 1e6});
}

void AugmentedOptions::visit(OptionVisitor& v) {
  v.number({"alpha_slow", "share of a new measurement in the long-term average", {"recovery_alpha_slow"}},
           alpha_slow, {0.0, 1.0});
  v.number({"alpha_fast", "likewise in the short-term average", {"recovery_alpha_fast"}}, alpha_fast,
           {0.0, 1.0});
}

void AugmentedOptions::validate() const {
  if (alpha_slow < alpha_fast || (alpha_slow == 0.0 && alpha_fast == 0.0)) return;
  throw ConfigurationError("filter.augmented.alpha_slow", "is not below alpha_fast", "make it smaller");
}

}  // namespace cairn
