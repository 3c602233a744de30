#pragma once

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// The names of all recipes, the simplest first.
std::vector<std::string> recipe_names();

/// Builds the particle filter that `options.recipe` names:
///   mcl       a fixed number of particles, resampling when the effective sample size has fallen
///   kld_mcl   as many as KLD-sampling asks for, resampling before every prediction
///   cgr       corrective gradient refinement: few particles, moved along the gradient of each measurement
///   amcl      kld_mcl; while measurements are worse than usual, particles come from p(x | z)
/// and those of Sehestedt & Schneider (ICINCO 2006), with samples of p(x | z) where they say so:
///   srl       mcl with sensor resetting (their section 3.1)
///   kld_srl   kld_mcl; the particles by which the set grows come from p(x | z) (table 2), while measurements
///             fit worse than usual (decision 73)
///   csrl      srl with two-stage cluster sampling, no resetting while there are several clusters (table 3)
///   ckld_srl  kld_srl with two-stage cluster sampling, never fewer particles while there are several (table
///             4); what speaks against a cluster in each scan is remembered (two_stage.hpp, decision 98)
/// and of our own:
///   ckld_mcl  kld_mcl with the same sampling, without samples of p(x | z): hypotheses are kept apart until
///             the evidence of the last half metre or so tells
/// The scheme that `options.filter.resampling` names is that of the recipes without clusters.
/// @param map where p(x | z) is sampled: not needed by mcl, kld_mcl and cgr
/// @throws ConfigurationError for an unknown name, and if a map is needed and missing
ParticleFilter<Pose2, Pose2> make_filter(const LocalizerOptions& options, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor,
                                         const OccupancyGrid* map = nullptr);

/// True for the recipes that draw samples of p(x | z): from the measurement's own model where it can
/// (BoundUpdate::sample), else from poses all over the free space of the map, weighed by it.
bool samples_from_measurements(const std::string& recipe);

}  // namespace cairn
