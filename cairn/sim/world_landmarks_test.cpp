#include "cairn/sim/world_landmarks.hpp"

#include "cairn/core/angle.hpp"
#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr int kScans = 3000;

WorldLandmarkDetectorOptions exact_detector() {
  WorldLandmarkDetectorOptions o;
  o.sigma_range_m = o.sigma_range_share = o.sigma_bearing_rad = o.missed_share = o.false_per_scan = 0.0;
  return o;
}

std::vector<int> ids_of(const LandmarkDetections& seen) {
  std::vector<int> ids;
  for (const LandmarkDetection& d : seen.detections) ids.push_back(d.id);
  return ids;
}

TEST(WorldLandmarks, AreSeenInViewInRangeAndInSight) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.walls.push_back({"wall", "2.5,2 4,2", false, "opaque", true});
    o.walls.push_back({"pane", "2,0.8 2,1.2", false, "glass", true});
    o.walls.push_back({"low", "2.5,0.5 2.5,1.5", false, "opaque", true, 0.5});
  });
  const std::vector<PlacedLandmark> marks{
      {{4.0, 1.0}, 1}, {{1.0, 4.0}, 2}, {{4.5, 2.8}, 3}, {{7.9, 5.9}, 4}, {{4.0, 0.0}, 5}};
  const LandmarkDetections seen = simulate_landmarks(scene.view(), exact_detector(), marks);
  EXPECT_EQ(ids_of(seen), (std::vector<int>{1, 5}))
      << "2: out of view, 3: behind a wall, 4: too far; glass and "
         "what is low hide nothing, what hangs on a wall is seen";
  EXPECT_NEAR(seen.detections[0].range_m, 3.0, 1e-12);
  EXPECT_NEAR(seen.detections[0].bearing_rad, 0.0, 1e-12);
  EXPECT_NEAR(seen.detections[1].bearing_rad, std::atan2(-1.0, 3.0), 1e-12);
}

// Each within 6 standard deviations of its estimate (alpha 2e-9).
TEST(WorldLandmarks, ErrorsAreAsFrequentAndAsLargeAsAsked) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  const std::vector<PlacedLandmark> marks{{{5.0, 1.0}, 7}};
  WorldLandmarkDetectorOptions o = exact_detector();
  o.sigma_range_m = 0.02;
  o.sigma_range_share = 0.01;
  o.sigma_bearing_rad = 0.03;
  o.missed_share = 0.2;
  double ranges = 0.0, bearings = 0.0;
  int seen = 0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    for (const LandmarkDetection& d : simulate_landmarks(scene.view(index), o, marks).detections) {
      ++seen;
      ranges += std::pow(d.range_m - 4.0, 2.0);
      bearings += d.bearing_rad * d.bearing_rad;
    }
  }
  EXPECT_NEAR(seen / static_cast<double>(kScans), 0.8, 6.0 * std::sqrt(0.2 * 0.8 / kScans));
  EXPECT_NEAR(std::sqrt(ranges / seen), 0.06, 6.0 * 0.06 / std::sqrt(2.0 * seen));
  EXPECT_NEAR(std::sqrt(bearings / seen), 0.03, 6.0 * 0.03 / std::sqrt(2.0 * seen));
}

// A Poisson number has its mean as variance: within 6 standard deviations (alpha 2e-9 each; the second moment
// of its square is 2 * mean^2 + mean).
TEST(WorldLandmarks, FalseOnesAreAPoissonNumberAnywhereInView) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  const std::vector<PlacedLandmark> marks{{{0.5, 1.0}, 7}};  // behind the robot
  WorldLandmarkDetectorOptions o = exact_detector();
  o.false_per_scan = 1.5;
  double count = 0.0, squares = 0.0, bearings = 0.0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    const LandmarkDetections seen = simulate_landmarks(scene.view(index), o, marks);
    count += static_cast<double>(seen.detections.size());
    squares += std::pow(static_cast<double>(seen.detections.size()) - 1.5, 2.0);
    for (const LandmarkDetection& d : seen.detections) {
      EXPECT_EQ(d.id, 7);
      EXPECT_LE(d.range_m, o.range_max_m);
      EXPECT_LE(std::abs(d.bearing_rad), 0.5 * o.field_of_view_rad);
      bearings += d.bearing_rad;
    }
  }
  EXPECT_NEAR(count / kScans, 1.5, 6.0 * std::sqrt(1.5 / kScans));
  EXPECT_NEAR(squares / kScans, 1.5, 6.0 * std::sqrt((2.0 * 1.5 * 1.5 + 1.5) / kScans));
  EXPECT_NEAR(bearings / count, 0.0, 6.0 * o.field_of_view_rad / std::sqrt(12.0 * count));
}

// Of two landmarks, half of the wrong names are right by chance: a tenth is wrong.
TEST(WorldLandmarks, SomeAreNamedWrongly) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  const std::vector<PlacedLandmark> marks{{{5.0, 1.0}, 1}, {{0.5, 1.0}, 2}};
  WorldLandmarkDetectorOptions o = exact_detector();
  o.wrong_id_share = 0.2;
  int wrong = 0;
  for (std::uint64_t index = 0; index < kScans; ++index)
    wrong += simulate_landmarks(scene.view(index), o, marks).detections.at(0).id == 2 ? 1 : 0;
  EXPECT_NEAR(wrong / static_cast<double>(kScans), 0.1, 6.0 * std::sqrt(0.1 * 0.9 / kScans));
}

}  // namespace
}  // namespace cairn
