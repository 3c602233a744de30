#pragma once

#include <span>
#include <vector>

namespace cairn {

/// Largest exponent b in (0, largest] with which the likelihoods may enter so that the particles keep an
/// effective sample size of at least `min_ess`: weights are proportional to exp(log_prior + b *
/// log_likelihood).
///
/// A likelihood that is much narrower than the spacing of the particles would leave one survivor, most likely
/// not the true one; a flatter likelihood keeps what the measurement could not yet tell apart, and the next
/// measurements finish the work (adaptive tempering: Jasra et al., Scand. J. Statist. 2011).
/// Returns `largest` if that keeps `min_ess`. Bisection to 1e-3 in log b; never below 1e-4 of `largest`,
/// which bounds the case in which the priors alone have a smaller effective sample size.
double tempering_exponent(std::span<const double> log_priors, std::span<const double> log_likelihoods,
                          double min_ess, double largest = 1.0);

/// The same with a buffer that is used again and again, so that it allocates only when it grows.
double tempering_exponent(std::span<const double> log_priors, std::span<const double> log_likelihoods,
                          double min_ess, double largest, std::vector<double>& scratch);

}  // namespace cairn
