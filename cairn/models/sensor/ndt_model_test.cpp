#include "cairn/models/sensor/ndt_model.hpp"

#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// One cell of 1 m around (0.5, 0.5) in layer 0 with occupancy 0.6; in no other layer.
std::shared_ptr<const NdtMap> one_cell() {
  const NdtGeometry geometry{{}, 1.0, 2, 2};
  return std::make_shared<const NdtMap>(geometry, std::vector<NdtCell>{{.index = 0,
                                                                        .points = 9.0,
                                                                        .mean = {0.5, 0.5},
                                                                        .xx = 0.03,
                                                                        .xy = 0.01,
                                                                        .yy = 0.02,
                                                                        .occupancy = 0.6}});
}

LaserScan one_beam(float range_m) { return {Time{}, 0.0, 0.1, 0.1, 8.0, {range_m}}; }

double score(NdtKind kind, const NdtModelOptions& options, const Pose2& pose) {
  double out = std::nan("");
  NdtModel(one_cell(), kind, {}, {}, options)
      .log_likelihood(one_beam(1.0f), std::span(&pose, 1), std::span(&out, 1));
  return out;
}

TEST(NdtModel, IsTheFormulaOfTheFourCells) {
  const NdtModelOptions options{.z_hit = 0.8, .z_rand = 0.2, .sigma_hit_m = 0.1};
  // End point (0.6, 0.7); covariance with noise (0.04, 0.01; 0.01, 0.03), determinant 0.0011.
  const double d2 = (0.03 * 0.01 - 2.0 * 0.01 * 0.02 + 0.04 * 0.04) / 0.0011;
  const double f = 0.25 * std::exp(-0.5 * d2);
  EXPECT_NEAR(score(NdtKind::kNdt, options, {-0.4, 0.7, 0.0}), std::log(0.8 * f + 0.2), 1e-12);
  EXPECT_NEAR(score(NdtKind::kOndt, options, {-0.4, 0.7, 0.0}), std::log(0.8 * 0.6 * f + 0.2), 1e-12);
  EXPECT_NEAR(score(NdtKind::kNdt, options, {50.0, 0.7, 0.0}), std::log(0.2), 1e-12);
}

TEST(NdtModel, ManyBeamsDoNotUnderflow) {
  NdtModelOptions options{.z_rand = 1e-9};
  options.max_beams = 0;
  options.effective_beams = 1e5;
  const auto map = std::make_shared<const NdtMap>(ndt_from_grid(test::mini_room(), {}));
  LaserScan scan = test::scan_of(test::mini_room(), {2.0, 1.2, 0.4}, 90);
  for (int i = 0; i < 4; ++i)
    scan.ranges_m.insert(scan.ranges_m.end(), scan.ranges_m.begin(), scan.ranges_m.end());
  const Pose2 far{99.0, 99.0, 0.0};
  double out = 0.0;
  NdtModel(map, NdtKind::kNdt, {}, {}, options).log_likelihood(scan, std::span(&far, 1), std::span(&out, 1));
  EXPECT_NEAR(out, static_cast<double>(select_end_points(scan, {}, {}, 0).size()) * std::log(1e-9), 1e-6);
}

TEST(NdtModel, ExplainsBeamsThatEndInADistribution) {
  const auto map = std::make_shared<const NdtMap>(ndt_from_grid(test::mini_room(), {}));
  const NdtModel model(map, NdtKind::kNdt, {}, {}, {});
  const Pose2 truth{2.0, 1.2, 0.4};
  const LaserScan scan = test::scan_of(test::mini_room(), truth, 60);
  EXPECT_GT(model.explained_share(scan, truth), 0.95);
  EXPECT_LT(model.explained_share(scan, truth * Pose2{0.5, 0.4, 0.9}), 0.6);
  EXPECT_EQ(model.explained_share({}, truth), 0.0);
}

}  // namespace
}  // namespace cairn
