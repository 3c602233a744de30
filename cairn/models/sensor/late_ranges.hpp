#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cairn {

/// How the ranges to radio beacons err (measured minus true). To each beacon, a share is wrong (anything);
/// the others are normal about one bias, and a share of these is late by an exponential delay as well,
/// because the direct way is obstructed.
struct LateRangeFit {
  struct Beacon {
    std::size_t count = 0;
    double wrong_share = 0.0;  ///< uniform within 20 m
    double late_share = 0.0;   ///< of the others
    double late_mean_m = 0.0;  ///< of what these are late; 0 if none is
  };

  double bias_m = 0.0;
  double sigma_m = 0.0;
  std::vector<Beacon> beacons;  ///< in the order of the groups
};

/// Maximum likelihood by expectation maximisation. A late range is the sum of a normal and an exponential
/// number (exponentially modified Gaussian; Grushka, "Characterization of exponentially modified Gaussian
/// peaks in chromatography", 1972); both of its parts are latent, so that no step lowers the likelihood.
/// @param errors_m  measured minus true, one group for each beacon; those beyond 20 m are left out
/// @throws InputError for fewer than ten errors in all, or one that is not finite
LateRangeFit fit_late_ranges(std::span<const std::vector<double>> errors_m);

}  // namespace cairn
