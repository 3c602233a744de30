#pragma once

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <cstdint>
#include <memory>

namespace cairn {

/// Builds the particle filter that `options.recipe` names:
///   mcl      a fixed number of particles, resampling when the effective sample size has fallen
///   kld_mcl  as many as KLD-sampling asks for, resampling before every prediction
/// by the scheme that `options.filter.resampling` names.
/// @throws ConfigurationError for an unknown name
ParticleFilter<Pose2, Pose2> make_filter(const LocalizerOptions& options, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor);

}  // namespace cairn
