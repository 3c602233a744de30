#include "cairn/localization/recipes.hpp"

#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

ParticleFilter<Pose2, Pose2> filter_of(const LocalizerOptions& options) {
  return make_filter(options, 1, std::make_shared<const Executor>());
}

// Particles over an area of `width_m` squared.
void spread(ParticleFilter<Pose2, Pose2>& filter, double width_m) {
  filter.initialize([&](const RandomStream& random, std::uint32_t i) {
    const auto u = random.uniform4(i);
    return Pose2{width_m * u[0], width_m * u[1], 6.28 * u[2] - 3.14};
  });
}

TEST(Recipes, MclKeepsItsNumberOfParticles) {
  LocalizerOptions options;
  options.recipe = "mcl";
  options.filter.particles = 123;
  auto filter = filter_of(options);
  for (const double width_m : {0.0, 50.0}) {
    spread(filter, width_m);
    EXPECT_EQ(filter.particles().size(), 123U);
  }
}

TEST(Recipes, KldMclTakesAsManyAsTheSpreadAsksForWithinItsLimits) {
  LocalizerOptions options;
  options.recipe = "kld_mcl";
  options.filter.min_particles = 100;
  options.filter.max_particles = 3000;
  auto filter = filter_of(options);
  filter.initialize([](const RandomStream&, std::uint32_t) { return Pose2{}; });
  EXPECT_EQ(filter.particles().size(), 100U);
  spread(filter, 1.0);
  EXPECT_GT(filter.particles().size(), 100U);
  EXPECT_LT(filter.particles().size(), 3000U);
  spread(filter, 200.0);
  EXPECT_EQ(filter.particles().size(), 3000U);
}

TEST(Recipes, RefusesAnUnknownName) {
  LocalizerOptions options;
  options.recipe = "amcl";
  EXPECT_THROW(filter_of(options), ConfigurationError);
}

}  // namespace
}  // namespace cairn
