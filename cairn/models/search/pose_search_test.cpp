#include "cairn/models/search/pose_search.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/sensor/likelihood_field_reference.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A room of 4 x 3 m, cells of 10 cm, turned and moved in the map frame.
OccupancyGrid tiny_room(const Pose2& T_map_grid) {
  std::vector<std::string> lines(30, "#" + std::string(38, ' ') + "#");
  lines.front() = lines.back() = std::string(40, '#');
  for (std::size_t row = 4; row < 12; ++row) lines[row].replace(25, 6, "######");
  for (std::size_t row = 20; row < 29; ++row) lines[row].replace(1, 4, "####");
  return test::draw_grid(lines, 0.1, T_map_grid);
}

std::vector<Point2> points_from(const OccupancyGrid& map, const Pose2& pose, int beams) {
  return select_end_points(test::scan_of(map, pose, beams), Pose2{}, {}, 0);
}

double turn(double a, double b) { return std::abs(normalize_angle(a - b)); }

// All poses of the lattice, one by one: headings as many as the search says that it looked at.
std::vector<FoundPose> brute_force(const OccupancyGrid& map, const PoseSearch& search,
                                   const std::vector<Point2>& points, std::int64_t headings,
                                   const PoseSearchQuery& query) {
  std::vector<FoundPose> all;
  const GridGeometry& grid = map.geometry();
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (map.state(cell) != CellState::kFree) continue;
    const Point2 p = grid.center(static_cast<int>(cell) % grid.width, static_cast<int>(cell) / grid.width);
    for (std::int64_t a = 0; a < headings; ++a) {
      const double theta = kTwoPi * static_cast<double>(a) / static_cast<double>(headings);
      const Pose2 pose{p.x, p.y, normalize_angle(theta + grid.T_map_grid.theta)};
      all.push_back({pose, search.log_likelihood(points, pose)});
    }
  }
  std::sort(all.begin(), all.end(),
            [](const FoundPose& a, const FoundPose& b) { return a.log_likelihood > b.log_likelihood; });
  std::vector<FoundPose> best;
  for (const FoundPose& found : all) {
    const bool distinct = std::none_of(best.begin(), best.end(), [&](const FoundPose& other) {
      return distance(found.T_map_base, other.T_map_base) < query.separation_m &&
             turn(found.T_map_base.theta, other.T_map_base.theta) < query.separation_rad;
    });
    if (distinct) best.push_back(found);
    if (best.size() == static_cast<std::size_t>(query.most_poses)) break;
  }
  return best;
}

class PoseSearchOracle : public ::testing::TestWithParam<Pose2> {};

/// In a tiny room, with a model that looks closely or one that looks from afar.
void expect_what_all_poses_give(const Pose2& T_grid_base, const LikelihoodFieldOptions& model) {
  const OccupancyGrid map = tiny_room({-3.0, 2.0, 0.4});
  const PoseSearch search(map, model);
  const Pose2 truth = map.geometry().T_map_grid * T_grid_base;
  const std::vector<Point2> points = points_from(map, truth, 24);
  const PoseSearchQuery query{.most_poses = 4};
  const PoseSearchResult result = search.find(points, query);
  const auto cells = static_cast<std::int64_t>(map.count(CellState::kFree));
  const auto expected = brute_force(map, search, points, result.lattice_poses / cells, query);
  EXPECT_TRUE(result.complete);
  ASSERT_EQ(result.poses.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(result.poses[i].log_likelihood, expected[i].log_likelihood, 1e-3) << i;
  }
  EXPECT_NEAR(distance(result.poses[0].T_map_base, truth), 0.0, 0.15);
  EXPECT_NEAR(turn(result.poses[0].T_map_base.theta, truth.theta), 0.0, 0.06);
}

TEST_P(PoseSearchOracle, FindsWhatTryingAllPosesFinds) { expect_what_all_poses_give(GetParam(), {}); }

// The neighbours of the best pose are better than the second of those that are asked for.
TEST_P(PoseSearchOracle, NeighboursOfTheBestPoseHideNoOther) {
  LikelihoodFieldOptions wide;
  wide.sigma_hit_m = 0.4;
  expect_what_all_poses_give(GetParam(), wide);
}

INSTANTIATE_TEST_SUITE_P(Poses, PoseSearchOracle,
                         ::testing::Values(Pose2{1.0, 1.4, 0.3}, Pose2{3.3, 0.6, -2.9},
                                           Pose2{3.4, 2.5, 1.7}));

TEST(PoseSearch, ScoresAsTheLikelihoodField) {
  const OccupancyGrid map = test::mini_room();
  LikelihoodFieldOptions model;
  model.max_beams = 0;
  model.effective_beams = 1e5;
  const LikelihoodFieldReference field(std::make_shared<const DistanceField>(map, model.max_distance_m), {},
                                       {}, model);
  const PoseSearch search(map, model);
  const LaserScan scan = test::scan_of(map, {2.0, 3.0, 0.5}, 90);
  for (const Pose2& pose : {Pose2{2.0, 3.0, 0.5}, Pose2{6.1, 1.2, -2.0}, Pose2{-50.0, 0.0, 0.0}}) {
    double expected = 0.0;
    field.log_likelihood(scan, std::span(&pose, 1), std::span(&expected, 1));
    EXPECT_NEAR(search.log_likelihood(select_end_points(scan, {}, {}, 0), pose), expected, 1e-3);
  }
}

TEST(PoseSearch, ASquareRoomHasFourPoses) {
  std::vector<std::string> lines(41, "#" + std::string(39, ' ') + "#");
  lines.front() = lines.back() = std::string(41, '#');
  const OccupancyGrid map = test::draw_grid(lines, 0.1);
  const PoseSearch search(map, {});
  const auto result = search.find(points_from(map, {1.2, 1.7, 0.2}, 60), {.most_poses = 10, .margin = 40.0});
  ASSERT_GE(result.poses.size(), 4u);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Pose2 about{2.05, 2.05, quarter * kPi / 2.0};
    const Pose2 twin = about * between(Pose2{2.05, 2.05, 0.0}, Pose2{1.2, 1.7, 0.2});
    const bool found = std::any_of(result.poses.begin(), result.poses.end(), [&](const FoundPose& p) {
      return distance(p.T_map_base, twin) < 0.2 && turn(p.T_map_base.theta, twin.theta) < 0.1;
    });
    EXPECT_TRUE(found) << quarter;
  }
}

TEST(PoseSearch, StaysInItsRegion) {
  const OccupancyGrid map = test::mini_room();
  const PoseSearch search(map, {});
  const auto points = points_from(map, {2.0, 3.0, 0.5}, 60);
  const PoseSearchQuery query{.most_poses = 5, .region = MapRegion{{4.0, 0.5}, {7.0, 2.0}}};
  for (const FoundPose& found : search.find(points, query).poses) {
    EXPECT_GE(found.T_map_base.x, 4.0);
    EXPECT_LE(found.T_map_base.x, 7.0);
    EXPECT_LE(found.T_map_base.y, 2.0);
  }
  const PoseSearchQuery nowhere{.region = MapRegion{{100.0, 0.0}, {101.0, 1.0}}};
  EXPECT_TRUE(search.find(points, nowhere).poses.empty());
}

TEST(PoseSearch, LeavesOutWhatIsFarBelowTheBest) {
  const OccupancyGrid map = test::mini_room();
  const PoseSearch search(map, {});
  const auto points = points_from(map, {2.0, 3.0, 0.5}, 60);
  const auto all = search.find(points, {.most_poses = 5});
  ASSERT_EQ(all.poses.size(), 5u);
  const double gap = all.poses[0].log_likelihood - all.poses[1].log_likelihood;
  const auto near = search.find(points, {.most_poses = 5, .margin = 0.5 * gap});
  EXPECT_EQ(near.poses.size(), 1u);
  EXPECT_LT(near.evaluated, all.evaluated);
}

TEST(PoseSearch, SaysWhenTheBudgetEndedIt) {
  const OccupancyGrid map = test::mini_room();
  const PoseSearch search(map, {});
  const auto result = search.find(points_from(map, {2.0, 3.0, 0.5}, 60), {.most_poses = 3, .budget = 1000});
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.poses.empty());
}

TEST(PoseSearch, BadPointsAreLeftOut) {
  const OccupancyGrid map = test::mini_room();
  const PoseSearch search(map, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(search.find({}, {}).poses.empty());
  const std::vector<Point2> bad{{nan, 0.0}, {0.0, inf}, {1e30, 1.0}};
  EXPECT_TRUE(search.find(bad, {}).poses.empty());
  std::vector<Point2> mixed = points_from(map, {2.0, 3.0, 0.5}, 60);
  const Pose2 clean = search.find(mixed, {.most_poses = 1}).poses.at(0).T_map_base;
  mixed.insert(mixed.end(), bad.begin(), bad.end());
  EXPECT_NEAR(distance(search.find(mixed, {.most_poses = 1}).poses.at(0).T_map_base, clean), 0.0, 0.06);
}

TEST(PoseSearch, AMapWithoutFreeCellsIsRefused) {
  EXPECT_THROW(PoseSearch(test::draw_grid({"##", "??"}), {}), ConfigurationError);
}

}  // namespace
}  // namespace cairn
