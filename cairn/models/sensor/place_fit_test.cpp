#include "cairn/models/sensor/place_fit.hpp"

#include "mini_maps.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

class PlaceFitTest : public testing::Test {
 protected:
  double fit(Pose2 place) const { return fit_.follow(scan_, place); }

  OccupancyGrid map_ = test::mini_room();
  std::shared_ptr<const DistanceField> walls_ = std::make_shared<const DistanceField>(map_, 2.0);
  PlaceFit fit_{std::make_shared<const BeamClassifier>(std::make_shared<const OccupancyGrid>(map_), walls_,
                                                       std::make_shared<const RayMarcher>(map_, 50.0),
                                                       Pose2{}, BeamLimits{}),
                walls_, Pose2{}, BeamLimits{}};
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
  EXPECT_NEAR(fit_.follow(scan_, place), 0.0, 0.05);
}

TEST_F(PlaceFitTest, AWrongPlaceFitsWorse) { EXPECT_LT(fit({6.8, 1.2, 2.5}), fit(truth_) - 0.5); }

TEST_F(PlaceFitTest, PeopleSpoilTheTruePlaceLessThanWallsThatBeamsPassThrough) {
  for (std::size_t i = 0; i < 90; ++i) scan_.ranges_m[i] = std::min(scan_.ranges_m[i], 0.4f);
  EXPECT_GT(fit(truth_), -1.2);  // half of the beams at log 0.15
  EXPECT_LT(fit({6.8, 1.2, 2.5}), fit(truth_));
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
