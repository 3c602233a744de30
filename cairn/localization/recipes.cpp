#include "cairn/localization/recipes.hpp"

#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/core/errors.hpp"

namespace cairn {
namespace {

using Filter = ParticleFilter<Pose2, Pose2>;

Filter compose(const LocalizerOptions& options, std::unique_ptr<SampleSize<Pose2>> size,
               const TriggerOptions& resample_when, std::uint64_t seed,
               std::shared_ptr<const Executor> executor) {
  auto motion = std::make_shared<const DifferentialDrive>(options.motion);
  Filter::Parts parts{.size = std::move(size),
                      .resampling = make_resampling(options.filter.resampling),
                      .resample_when = make_trigger(resample_when),
                      .regularization = std::make_unique<PoseKernel>(options.filter.kernel)};
  return Filter(std::move(motion), std::move(parts), std::move(executor),
                {.seed = seed, .min_ess_share = options.filter.min_ess_share});
}

}  // namespace

ParticleFilter<Pose2, Pose2> make_filter(const LocalizerOptions& options, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor) {
  const FilterOptions& f = options.filter;
  if (options.recipe == "mcl") {
    auto size = std::make_unique<FixedSize<Pose2>>(static_cast<std::size_t>(f.particles));
    return compose(options, std::move(size), f.resample, seed, std::move(executor));
  }
  if (options.recipe == "kld_mcl") {
    auto size = std::make_unique<KldSize>(f.kld, static_cast<std::size_t>(f.min_particles),
                                          static_cast<std::size_t>(f.max_particles));
    TriggerOptions resample = f.resample;
    resample.ess_ratio = 1.0;  // resampling is what adapts the number
    return compose(options, std::move(size), resample, seed, std::move(executor));
  }
  throw ConfigurationError("recipe", "'" + options.recipe + "' is not known", "use mcl or kld_mcl");
}

}  // namespace cairn
