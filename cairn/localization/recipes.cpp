#include "cairn/localization/recipes.hpp"

#include "cairn/bayes/injections/injections.hpp"
#include "cairn/bayes/injections/measurement_source.hpp"
#include "cairn/bayes/injections/worse_than_usual.hpp"
#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/bayes/resampling/two_stage.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/free_space_source.hpp"

namespace cairn {
namespace {

using Filter = ParticleFilter<Pose2, Pose2>;
using Size = std::unique_ptr<SampleSize<Pose2>>;
constexpr Pose2 kOffTheMap{1e7, 1e7, 0.0};
constexpr double kForgetsAll = 0.0;  // the paper's eta = 1 / C_j

using Source = std::shared_ptr<const SampleFrom<Pose2>>;

/// What recipes are composed of.
struct Kitchen {
  const LocalizerOptions& options;
  std::uint64_t seed;
  std::shared_ptr<const Executor> executor;
  const OccupancyGrid* map;
  std::shared_ptr<ClusterTable> clusters = std::make_shared<ClusterTable>();

  const FilterOptions& filter() const { return options.filter; }
  double beams() const { return options.laser.likelihood_field.effective_beams; }

  Size fixed() const {
    return std::make_unique<FixedSize<Pose2>>(static_cast<std::size_t>(filter().particles));
  }
  Size kld() const {
    return std::make_unique<KldSize>(filter().kld, static_cast<std::size_t>(filter().min_particles),
                                     static_cast<std::size_t>(filter().max_particles));
  }
  Size never_fewer() const { return std::make_unique<NeverFewerWhileClustered>(clusters, kld()); }
  Source source() const {
    if (map == nullptr)
      throw ConfigurationError("recipe", "'" + options.recipe + "' needs a map of cells",
                               "use mcl or kld_mcl");
    return std::make_shared<const MeasurementSource<Pose2>>(std::make_unique<const FreeSpaceSource>(
        GlobalStart(*map, filter().source_per_m2, seed + 1), executor));
  }
  std::unique_ptr<Injection<Pose2>> resetting() const {
    return std::make_unique<SensorResetting<Pose2>>(filter().resetting, beams(), source());
  }
  /// Tables 2 and 4, step 2, while something is wrong (decision 73).
  std::unique_ptr<Injection<Pose2>> growing() const {
    const LikelihoodFieldOptions& beam = options.laser.likelihood_field;
    return std::make_unique<WhileWorseThanUsual<Pose2>>(
        WhileWorseThanUsual<Pose2>::Usual{.averages = filter().augmented,
                                          .nowhere = kOffTheMap,
                                          .least = beam.z_rand / (beam.z_hit + beam.z_rand)},
        std::make_unique<NewFromMeasurement<Pose2>>(source()));
  }
  TriggerOptions always() const {
    TriggerOptions trigger = filter().resample;
    trigger.ess_ratio = 1.0;  // resampling is what adapts the number, and what keeps the clusters
    return trigger;
  }

  Filter::Parts plain(Size size, const TriggerOptions& trigger) const {
    return {.size = std::move(size),
            .resampling = make_resampling(filter().resampling),
            .resample_when = make_trigger(trigger),
            .regularization = std::make_unique<PoseKernel>(filter().kernel)};
  }
  Filter::Parts clustered(Size size, double memory) const {
    auto parts = plain(std::move(size), always());
    parts.resampling = std::make_unique<TwoStage>(clusters, memory);
    parts.regularization =
        std::make_unique<ClusterWatch>(clusters, filter().clusters, std::move(parts.regularization));
    return parts;
  }
  Filter serve(Filter::Parts parts) const {
    return {std::make_shared<const DifferentialDrive>(options.motion),
            std::move(parts),
            executor,
            {.seed = seed, .min_ess_share = filter().min_ess_share}};
  }
};

Filter mcl(const Kitchen& k) { return k.serve(k.plain(k.fixed(), k.filter().resample)); }

Filter kld_mcl(const Kitchen& k) { return k.serve(k.plain(k.kld(), k.always())); }

Filter cgr(const Kitchen& k) {
  const CgrOptions& options = k.options.cgr;
  auto parts = k.plain(std::make_unique<FixedSize<Pose2>>(static_cast<std::size_t>(options.particles)),
                       k.filter().resample);
  parts.refinement = std::make_unique<GradientRefinement>(options.refinement);
  return k.serve(std::move(parts));
}

Filter amcl(const Kitchen& k) {
  auto parts = k.plain(k.kld(), k.always());
  parts.injection = std::make_unique<Augmented<Pose2>>(k.filter().augmented, k.beams(), k.source());
  return k.serve(std::move(parts));
}

Filter srl(const Kitchen& k) {
  auto parts = k.plain(k.fixed(), k.filter().resample);
  parts.injection = k.resetting();
  return k.serve(std::move(parts));
}

Filter kld_srl(const Kitchen& k) {
  auto parts = k.plain(k.kld(), k.always());
  parts.injection = k.growing();
  return k.serve(std::move(parts));
}

Filter csrl(const Kitchen& k) {
  auto parts = k.clustered(k.fixed(), kForgetsAll);
  parts.injection = std::make_unique<OnlyWithOneCluster<Pose2>>(k.clusters, k.resetting());
  return k.serve(std::move(parts));
}

Filter ckld_srl(const Kitchen& k) {
  auto parts = k.clustered(k.never_fewer(), k.filter().cluster_memory);
  parts.injection = k.growing();
  return k.serve(std::move(parts));
}

Filter ckld_mcl(const Kitchen& k) { return k.serve(k.clustered(k.never_fewer(), k.filter().cluster_memory)); }

struct Recipe {
  const char* name;
  Filter (*make)(const Kitchen&);
};
constexpr Recipe kRecipes[] = {{"mcl", mcl},   {"kld_mcl", kld_mcl},   {"cgr", cgr},
                               {"amcl", amcl}, {"srl", srl},           {"kld_srl", kld_srl},
                               {"csrl", csrl}, {"ckld_srl", ckld_srl}, {"ckld_mcl", ckld_mcl}};

}  // namespace

std::vector<std::string> recipe_names() {
  std::vector<std::string> names;
  for (const Recipe& recipe : kRecipes) names.emplace_back(recipe.name);
  return names;
}

bool samples_from_measurements(const std::string& recipe) {
  return recipe == "amcl" || recipe == "srl" || recipe == "kld_srl" || recipe == "csrl" ||
         recipe == "ckld_srl";
}

ParticleFilter<Pose2, Pose2> make_filter(const LocalizerOptions& options, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor, const OccupancyGrid* map) {
  std::string known;
  for (const Recipe& recipe : kRecipes) {
    if (options.recipe == recipe.name) return recipe.make({options, seed, std::move(executor), map});
    known += (known.empty() ? "" : ", ") + std::string(recipe.name);
  }
  throw ConfigurationError("recipe", "'" + options.recipe + "' is not known", "use one of " + known);
}

}  // namespace cairn
