#include "cairn/models/sensor/place_fit.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "mini_maps.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

class PlaceFitTest : public testing::Test {
 protected:
  double fit(Pose2 place) const { return fit_.follow(scan_, place); }
  PlaceFit make(const PlaceFitOptions& options) const {
    return {std::make_shared<const BeamClassifier>(std::make_shared<const OccupancyGrid>(map_), walls_,
                                                   std::make_shared<const RayMarcher>(map_, 50.0), Pose2{},
                                                   BeamLimits{}),
            walls_, Pose2{}, BeamLimits{}, options};
  }
  double fit_with_every_fourth_range(float factor, const PlaceFitOptions& options) {
    scan_ = test::scan_of(map_, truth_, 180);
    for (std::size_t i = 0; i < 180; i += 4) scan_.ranges_m[i] *= factor;
    Pose2 place = truth_;
    return make(options).follow(scan_, place);
  }

  OccupancyGrid map_ = test::mini_room();
  std::shared_ptr<const DistanceField> walls_ = std::make_shared<const DistanceField>(map_, 2.0);
  PlaceFit fit_ = make({});
  Pose2 truth_{3.0, 2.0, 0.4};
  LaserScan scan_ = test::scan_of(map_, truth_, 180);
};

TEST_F(PlaceFitTest, APlaceMovesToWhereTheScanFits) {
  Pose2 place = truth_ * Pose2{0.1, -0.08, 0.04};
  const double before = fit_.follow(scan_, place);
  for (int i = 0; i < 3; ++i) fit_.follow(scan_, place);
  EXPECT_LT(distance(place, truth_), 0.03);
  EXPECT_NEAR(place.theta, truth_.theta, 0.01);
  EXPECT_GE(fit_.follow(scan_, place), before);
  EXPECT_NEAR(make({.residual = 0.0}).follow(scan_, place), 0.0, 0.05);
  EXPECT_NEAR(fit_.follow(scan_, place), 0.0, 0.1);  // half a cell is a residual, too
}

// Both explain all beams within the tolerance.
TEST_F(PlaceFitTest, ResidualsTellPlacesApartThatExplainTheSameBeams) {
  const auto off = [&](double residual) {
    const PlaceFit fit = make({.reach_m = 1e-9, .reach_rad = 1e-9, .residual = residual});
    Pose2 right = truth_, beside = truth_ * Pose2{0.12, 0.0, 0.0};
    return fit.follow(scan_, right) - fit.follow(scan_, beside);
  };
  EXPECT_NEAR(off(0.0), 0.0, 0.05);
  EXPECT_GT(off(1.5), 0.3);
}

TEST_F(PlaceFitTest, AWrongPlaceFitsWorse) { EXPECT_LT(fit({6.8, 1.2, 2.5}), fit(truth_) - 0.5); }

TEST_F(PlaceFitTest, PeopleSpoilTheTruePlaceLessThanWallsThatBeamsPassThrough) {
  for (std::size_t i = 0; i < 90; ++i) scan_.ranges_m[i] = std::min(scan_.ranges_m[i], 0.4f);
  EXPECT_GT(fit(truth_), -1.2);  // half of the beams at log 0.15
  EXPECT_LT(fit({6.8, 1.2, 2.5}), fit(truth_));
}

// A quarter of the beams, at 4 nat each beyond a wall and at `blocked` before it. Some that pass a wall end
// near another one by chance.
TEST_F(PlaceFitTest, BeamsCostWhatTheirClassCosts) {
  for (const double blocked : {0.25, 0.8}) {
    const PlaceFitOptions options{.blocked = blocked, .residual = 0.0};
    const double through = fit_with_every_fourth_range(1.5f, options);
    const double before = fit_with_every_fourth_range(0.5f, options);
    EXPECT_LT(before, -blocked * 0.25 * 0.8);
    EXPECT_GT(before, -blocked * 0.25 * 1.05 - 0.05);
    EXPECT_LT(through, -4.0 * 0.25 * 0.5);
  }
}

TEST_F(PlaceFitTest, NoPlaceMovesToAWorseOne) {
  for (std::size_t i = 0; i < 90; ++i) scan_.ranges_m[i] = std::min(scan_.ranges_m[i], 0.4f);
  const PlaceFit still = make({.reach_m = 1e-9, .reach_rad = 1e-9});
  const RandomStream random(1, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto u = random.uniform4(i);
    const Pose2 place{8.0 * u[0], 5.0 * u[1], kTwoPi * u[2] - kPi};
    Pose2 stays = place;
    EXPECT_GE(fit(place), still.follow(scan_, stays) - 1e-9) << i;
  }
}

TEST_F(PlaceFitTest, AScanWithoutABeamSaysNothingAndMovesNothing) {
  scan_.ranges_m.assign(scan_.ranges_m.size(), 0.0f);
  Pose2 place = truth_;
  EXPECT_EQ(fit_.follow(scan_, place), 0.0);
  EXPECT_EQ(place.x, truth_.x);
}

TEST_F(PlaceFitTest, OffTheMapIsAPlaceLikeAnyOther) {
  EXPECT_LT(fit({1e6, 0.0, 0.0}), -1.0);
  EXPECT_LT(fit({-50.0, 2.0, 1.0}), -1.0);
}

}  // namespace
}  // namespace cairn
