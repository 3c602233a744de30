#include "cairn/models/sensor/likelihood_field.hpp"
#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Pose2 kTMapGrid{0.313, -0.217, 0.4};
const Pose2 kTruth{2.3, 1.4, 0.7};

LikelihoodPlane plane() {
  const DistanceField field(test::mini_room(kTMapGrid), 2.0);
  const LikelihoodFieldOptions options{.sigma_hit_m = 0.2};
  return {field, LikelihoodPlane::Codes::k16Bit, [&](double d) { return options.log_likelihood(d); }};
}

std::vector<Point2> points() {
  return select_end_points(test::scan_of(test::mini_room(kTMapGrid), kTruth, 60), {}, {}, 0);
}

Pose2 near_truth(std::uint32_t i) {
  const auto n = RandomStream(9, RandomPurpose::kTest, 0).normal4(i);
  return kTruth * Pose2{0.1 * n[0], 0.1 * n[1], 0.05 * n[2]};
}

TEST(LikelihoodPlaneSlope, IsThatOfTheInterpolatedScore) {
  const LikelihoodPlane field = plane();
  const auto beams = points();
  constexpr double kStep = 1e-7;
  for (std::uint32_t i = 0; i < 30; ++i) {
    const Pose2 p = near_truth(i);
    const Eigen::Vector4d f = field.interpolate(beams, p);
    const Pose2 steps[] = {{kStep, 0, 0}, {0, kStep, 0}, {0, 0, kStep}};
    for (int k = 0; k < 3; ++k) {
      const Pose2& d = steps[k];
      const double above = field.interpolate(beams, {p.x + d.x, p.y + d.y, p.theta + d.theta})[0];
      const double below = field.interpolate(beams, {p.x - d.x, p.y - d.y, p.theta - d.theta})[0];
      EXPECT_NEAR(f[k + 1], (above - below) / (2.0 * kStep), 1e-3 * (1.0 + std::abs(f[k + 1])))
          << i << ' ' << k;
    }
  }
}

TEST(LikelihoodPlaneSlope, TheInterpolatedScoreIsThatOfTheCellsAtTheirCentres) {
  const LikelihoodPlane field = plane();
  const std::vector<Point2> here = {{0.0, 0.0}};
  const BeamsInCells cells = field.in_cells(here);
  const GridGeometry grid = test::mini_room(kTMapGrid).geometry();
  for (int i = 0; i < 60; ++i) {
    const Point2 center = grid.center((37 * i) % grid.width, (23 * i) % grid.height);
    const Pose2 p{center.x, center.y, 0.1 * i};
    std::uint32_t sum = 0;
    field.sum_codes(cells, std::span(&p, 1), std::span(&sum, 1));
    EXPECT_NEAR(field.interpolate(here, p)[0], field.log_likelihood(1, sum), 1e-6) << i;
  }
}

TEST(LikelihoodPlaneSlope, IsFlatFarAwayAndForWhatIsNotFinite) {
  const LikelihoodPlane field = plane();
  for (const Pose2& p : {Pose2{1e9, 0, 0}, Pose2{std::nan(""), 0, 0}, Pose2{-1e300, 1e300, 1}}) {
    const Eigen::Vector4d f = field.interpolate(points(), p);
    EXPECT_TRUE(f.allFinite());
    EXPECT_EQ(f.tail<3>().norm(), 0.0);
  }
}

// A refinement climbs this way: a small step up the gradient of the field raises its score.
TEST(LikelihoodFieldGradient, LeadsUphill) {
  const auto field = std::make_shared<const DistanceField>(test::mini_room(kTMapGrid), 2.0);
  const LikelihoodField model(field, {}, {}, {.sigma_hit_m = 0.2});
  const auto update = model.bind(test::scan_of(test::mini_room(kTMapGrid), kTruth, 60));
  ASSERT_TRUE(update.gradient);
  int uphill = 0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Pose2 p = near_truth(i);
    Eigen::Vector3d g;
    update.gradient(std::span(&p, 1), std::span(&g, 1));
    const Eigen::Vector3d step = 0.03 * g / std::hypot(g[0], g[1]);
    const Pose2 both[] = {p, {p.x + step[0], p.y + step[1], p.theta}};
    double scores[2];
    update.log_likelihood(both, scores);
    uphill += scores[1] > scores[0] ? 1 : 0;
  }
  EXPECT_GE(uphill, 45);
}

}  // namespace
}  // namespace cairn
