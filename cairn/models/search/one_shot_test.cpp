#include "cairn/models/search/one_shot.hpp"

#include "cairn/core/angle.hpp"
#include "mini_maps.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<Point2> points_from(const OccupancyGrid& map, const Pose2& pose, int beams) {
  return select_end_points(test::scan_of(map, pose, beams), Pose2{}, {}, 0);
}

TEST(OneShot, TellsTheOnePoseOfARoomWithoutSymmetry) {
  const OccupancyGrid map = test::mini_room();
  const Pose2 truth{2.03, 3.02, 0.5};
  const auto result = locate(PoseSearch(map, {}), points_from(map, truth, 120), {});
  ASSERT_FALSE(result.poses.empty());
  const LocatedPose& best = result.poses[0];
  EXPECT_LT(distance(best.T_map_base, truth), 0.05);
  EXPECT_LT(std::abs(normalize_angle(best.T_map_base.theta - truth.theta)), 0.02);
  EXPECT_GT(best.weight, 0.99);
  EXPECT_TRUE(result.search.complete);
  const Eigen::Vector3d error(best.T_map_base.x - truth.x, best.T_map_base.y - truth.y,
                              normalize_angle(best.T_map_base.theta - truth.theta));
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(error[i]), 4.0 * std::sqrt(best.covariance(i, i))) << i;
  EXPECT_LT(std::sqrt(best.covariance(0, 0)), 0.1);
}

TEST(OneShot, SymmetricPosesShareTheWeight) {
  std::vector<std::string> lines(61,
                                 "#" + std::string(39, ' ') + "#");  // 4 x 6 m: a half turn maps it to itself
  lines.front() = lines.back() = std::string(41, '#');
  const OccupancyGrid map = test::draw_grid(lines, 0.1);
  const auto result = locate(PoseSearch(map, {}), points_from(map, {1.22, 1.71, 0.2}, 120), {});
  ASSERT_GE(result.poses.size(), 2u);
  EXPECT_NEAR(result.poses[0].weight, 0.5, 0.15);
  EXPECT_NEAR(result.poses[1].weight, 0.5, 0.15);
  const double sum = std::accumulate(result.poses.begin(), result.poses.end(), 0.0,
                                     [](double s, const LocatedPose& p) { return s + p.weight; });
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(OneShot, NothingSeenNothingFound) {
  const OccupancyGrid map = test::mini_room();
  EXPECT_TRUE(locate(PoseSearch(map, {}), {}, {}).poses.empty());
}

}  // namespace
}  // namespace cairn
