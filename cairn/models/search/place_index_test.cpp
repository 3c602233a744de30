#include "cairn/models/search/place_index.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/grid_ray_caster.hpp"
#include "cairn/models/search/place_sampler.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

LaserScan half_scan(const OccupancyGrid& map, const Pose2& T_map_sensor) {
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = kPi / 179.0;
  scan.range_max_m = 40.0;
  for (int i = 0; i < 180; ++i) {
    const Pose2 ray = T_map_sensor * Pose2{0.0, 0.0, scan.angle_min_rad + i * scan.angle_increment_rad};
    scan.ranges_m.push_back(static_cast<float>(cast_ray(map, ray, 40.0)));
  }
  return scan;
}

double turn_between(const Pose2& a, const Pose2& b) { return std::abs(normalize_angle(a.theta - b.theta)); }

TEST(PlaceIndex, CoversTheFreeSpaceInAllHeadings) {
  const OccupancyGrid map = test::mini_room();
  const PlaceIndex index(map, {}, {});
  EXPECT_EQ(index.size() % 36, 0U);
  const double positions = static_cast<double>(index.size()) / 36.0;
  const double free_m2 = static_cast<double>(map.count(CellState::kFree)) * 0.05 * 0.05;
  EXPECT_GT(positions, free_m2 / 0.25 * 0.95);
  EXPECT_LT(positions, free_m2 / 0.25 * 1.35);  // squares that are partly free count as well
  for (std::size_t i = 0; i < index.size(); i += 36) {
    const Pose2 pose = index.place(i).T_map_sensor;
    EXPECT_EQ(map.state_at({pose.x, pose.y}), CellState::kFree);
  }
}

// Of 50 scans from anywhere in the room, the nearest signature is that of a place nearby.
TEST(PlaceIndex, TheNearestSignatureIsOfAPlaceNearby) {
  const OccupancyGrid map = test::mini_room();
  const PlaceIndex index(map, {}, {.spacing_m = 0.25, .headings = 72});
  const RandomStream random(7, RandomPurpose::kInitialize, 0);
  int tried = 0, near = 0;
  for (std::uint32_t i = 0; tried < 50; ++i) {
    const auto u = random.uniform4(i);
    const Pose2 truth{0.3 + 7.4 * u[0], 0.3 + 4.4 * u[1], normalize_angle(kTwoPi * u[2])};
    if (map.state_at({truth.x, truth.y}) != CellState::kFree) continue;
    ++tried;
    const auto found = index.nearest(signature_of(half_scan(map, truth), {}, index.shape()), 3);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(),
                               [](auto& a, auto& b) { return a.distance_m < b.distance_m; }));
    near += std::any_of(found.begin(), found.end(), [&](const auto& n) {
      const Pose2 pose = index.place(n.place).T_map_sensor;
      return distance(pose, truth) < 0.6 && turn_between(pose, truth) < 0.3;
    });
  }
  EXPECT_GE(near, 45);
}

TEST(PlaceIndex, IsTheSameFromItsOwnSignatures) {
  const OccupancyGrid map = test::mini_room();
  const PlaceIndex made(map, {}, {});
  const PlaceIndex again(map, {}, {}, std::vector<ScanSignature>(made.signatures()));
  const ScanSignature z = signature_of(half_scan(map, {2.0, 3.0, 0.5}), {}, made.shape());
  const auto a = made.nearest(z, 20), b = again.nearest(z, 20);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].place, b[i].place);
  EXPECT_EQ(PlaceIndex::places_on(map, {}), made.size());
}

TEST(PlaceIndex, KeepsItsSizeOnALargeMap) {
  const PlaceIndex index(test::mini_room(), {}, {.most_places = 2000});
  EXPECT_LE(index.size(), 3000U);
  EXPECT_GT(index.spacing_m(), 0.5);
}

TEST(PlaceIndex, BadInput) {
  const OccupancyGrid walls = test::draw_grid({"##", "##"});
  EXPECT_THROW(PlaceIndex(walls, {}, {}), ConfigurationError);
  EXPECT_THROW(PlaceIndex(test::mini_room(), {0.0, 0.0, 10.0}, {}), ConfigurationError);
  EXPECT_THROW(PlaceIndex(test::mini_room(), {}, {.spacing_m = -1.0}), ConfigurationError);
  EXPECT_THROW(PlaceIndex(test::mini_room(), {}, {.headings = 0}), ConfigurationError);
}

// Samples for one scan, by the likelihood field of the map.
std::vector<Pose2> samples_for(const std::shared_ptr<const OccupancyGrid>& map, const Pose2& truth,
                               const Pose2& mount, std::size_t count, std::uint64_t seed) {
  const LikelihoodField model(std::make_shared<const DistanceField>(*map, 2.0), mount, {}, {});
  const auto scan = std::make_shared<const LaserScan>(half_scan(*map, truth * mount));
  const PlaceSampler sampler(map, nullptr, mount, {});
  std::vector<Pose2> samples(count);
  sampler.bind(scan, model.bind(*scan).log_likelihood)(RandomStream(seed, RandomPurpose::kInject, 0),
                                                       samples);
  return samples;
}

TEST(PlaceSampler, SamplesStandWhereTheScanIsLikely) {
  const auto map = std::make_shared<const OccupancyGrid>(test::mini_room());
  const Pose2 truth{2.03, 3.02, 0.5};
  const auto samples = samples_for(map, truth, {0.2, 0.0, 0.0}, 500, 3);
  const auto near = std::count_if(samples.begin(), samples.end(), [&](const Pose2& p) {
    return distance(p, truth) < 0.5 && turn_between(p, truth) < 0.3;
  });
  EXPECT_GE(near, 450);
}

// In a room that a half turn maps to itself both poses are as likely. The share of one is a binomial of the
// few hundred effective candidates: within 0.35 to 0.65, beyond 5 standard deviations (false alarm below
// 1e-6).
TEST(PlaceSampler, SymmetricPosesGetEqualShares) {
  std::vector<std::string> lines(61, "#" + std::string(39, ' ') + "#");
  lines.front() = lines.back() = std::string(41, '#');
  const auto map = std::make_shared<const OccupancyGrid>(test::draw_grid(lines, 0.1));
  const Pose2 truth{1.22, 1.71, 0.2};
  const Pose2 other{4.1 - 1.22, 6.1 - 1.71, normalize_angle(0.2 + kPi)};
  double first = 0.0, second = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const Pose2& p : samples_for(map, truth, {}, 400, seed)) {
      first += distance(p, truth) < 0.6 && turn_between(p, truth) < 0.4;
      second += distance(p, other) < 0.6 && turn_between(p, other) < 0.4;
    }
  }
  EXPECT_GT(first + second, 0.9 * 4000);
  EXPECT_NEAR(first / (first + second), 0.5, 0.15);
}

TEST(PlaceSampler, TheSameSeedGivesTheSameSamples) {
  const auto map = std::make_shared<const OccupancyGrid>(test::mini_room());
  const auto a = samples_for(map, {2.0, 3.0, 0.5}, {}, 50, 1),
             b = samples_for(map, {2.0, 3.0, 0.5}, {}, 50, 1);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof(Pose2)), 0) << i;
}

}  // namespace
}  // namespace cairn
