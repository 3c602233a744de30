#include "cairn/models/sensor/amcl_likelihood_field.hpp"

#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// One beam ahead that ends at the centre of a cell `cells` short of the wall.
LaserScan one_beam(float range_m) { return {Time{}, 0.0, 0.1, 0.1, 8.0, {range_m}}; }

TEST(AmclLikelihoodField, IsOnePlusTheCubeOfTheBeam) {
  const auto grid = test::draw_grid({"    #"});
  const LikelihoodFieldOptions options{.z_hit = 0.6, .z_rand = 0.4, .sigma_hit_m = 0.5};
  const AmclLikelihoodField model(std::make_shared<const DistanceField>(grid, 2.0), {}, {}, options);
  for (const auto& [range, distance] : {std::pair{4.0f, 0.0}, {3.0f, 1.0}, {1.0f, 2.0}}) {
    const Pose2 here{0.5, 0.5, 0.0};
    double score = 0.0;
    model.log_likelihood(one_beam(range), std::span(&here, 1), std::span(&score, 1));
    const double p = 0.6 * std::exp(-distance * distance / 0.5) + 0.4 / 8.0;
    EXPECT_NEAR(score, std::log(1.0 + p * p * p), 1e-12) << range;
  }
}

TEST(AmclLikelihoodField, ExplainsBeamsThatEndAtWalls) {
  const auto grid = test::draw_grid({"    #"});
  const AmclLikelihoodField model(std::make_shared<const DistanceField>(grid, 2.0), {}, {}, {});
  EXPECT_EQ(model.explained_share(one_beam(4.0f), {0.5, 0.5, 0.0}), 1.0);
  EXPECT_EQ(model.explained_share(one_beam(2.0f), {0.5, 0.5, 0.0}), 0.0);
  EXPECT_EQ(model.explained_share(one_beam(4.0f), {99.0, 0.5, 0.0}), 0.0);
  EXPECT_EQ(model.explained_share(one_beam(0.0f), {0.5, 0.5, 0.0}), 0.0);
}

}  // namespace
}  // namespace cairn
