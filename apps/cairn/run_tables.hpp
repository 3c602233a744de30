#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/localization/estimate.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cairn::app {

// The text tables of a run directory. Stamps are seconds with nine decimals; every other number is the
// shortest decimal that reads back as the same double, so that equal results give equal bytes. The parsers
// take the whole text of a file and its name, and throw InputError "name:line: what; what to do" for a wrong
// header, a missing or surplus field, a word where a number belongs, NaN, infinity, and stamps that run
// backwards.

/// TUM text, see cairn/io/tum_trajectory.hpp; here an empty trajectory is an empty text.
std::string to_tum(const Trajectory& trajectory);
Trajectory parse_tum(const std::string& text, const std::string& name);

/// Columns `kEstimateHeader`: units m and rad, variances m^2, m rad and rad^2; weight is that of the heaviest
/// place, from `state` on they are those of Judgement.
std::string to_csv(const std::vector<Estimate>& estimates);
std::vector<Estimate> parse_estimates(std::string_view text, const std::string& name);
inline constexpr std::string_view kEstimateHeader =
    "stamp_s,x_m,y_m,theta_rad,var_x,cov_xy,cov_x_theta,var_y,cov_y_theta,var_theta,ess,particles,hypotheses,"
    "weight,quality,state,probability,explained,blocked,beyond,fit,innovation_m,entropy,drift_m";

/// Columns `kHypothesisHeader`: the rows of one stamp are the places of one instant, heaviest first; `place`
/// is the same number as long as a place is followed.
std::string to_csv(const std::vector<HypothesisSnapshot>& snapshots);
std::vector<HypothesisSnapshot> parse_hypotheses(std::string_view text, const std::string& name);
inline constexpr std::string_view kHypothesisHeader =
    "stamp_s,place,weight,age_s,x_m,y_m,theta_rad,var_x,cov_xy,cov_x_theta,var_y,cov_y_theta,var_theta";

/// Columns `kParticleHeader`: the rows of one stamp are one snapshot.
std::string to_csv(const std::vector<ParticleSnapshot>& snapshots);
std::vector<ParticleSnapshot> parse_particles(std::string_view text, const std::string& name);
inline constexpr std::string_view kParticleHeader = "stamp_s,x_m,y_m,theta_rad";

}  // namespace cairn::app
