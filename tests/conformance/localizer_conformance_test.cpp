// Every recipe as a localizer: whatever comes in ends in a named outcome, and nothing spoils the estimate.
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "recipes.hpp"
#include "small_room.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const Pose2 kStart{2.0, 1.5, 0.0};
const float kNan = std::numeric_limits<float>::quiet_NaN();

class LocalizerLaws : public ::testing::TestWithParam<RecipeCase> {
 protected:
  static MonteCarloLocalizer make(int threads = 1) {
    LocalizerOptions options = GetParam().options();
    options.filter.particles = 300;
    options.filter.min_particles = 200;
    options.filter.max_particles = 1000;
    return {options,
            odometry_and_laser(),
            small_room(),
            Start{kStart},
            1,
            std::make_shared<const Executor>(threads)};
  }

  static Event scan_at(double seconds) {
    static const OccupancyGrid kRoom = small_room();
    return scan_event(scan_from(kRoom, on_circle(kStart, seconds), at(seconds)));
  }

  static Event changed_scan(double seconds, const std::function<void(LaserScan&)>& change) {
    LaserScan scan = *std::get<std::shared_ptr<const LaserScan>>(scan_at(seconds).payload);
    change(scan);
    return scan_event(std::move(scan));
  }

  static void drive(MonteCarloLocalizer& localizer, int from, int to) {
    for (int i = from; i < to; ++i) {
      localizer.process(odometry_event(0.1 * i, on_circle({}, 0.1 * i)));
      if (i % 4 == 1) localizer.process(scan_at(0.1 * i - 0.03));
    }
  }

  static std::int64_t total(const MonteCarloLocalizer& localizer) {
    std::int64_t n = 0;
    for (const OutcomeCounts& counts : localizer.outcomes())
      n = std::accumulate(counts.begin(), counts.end(), n);
    return n;
  }
};

TEST_P(LocalizerLaws, WhatIsMalformedIsCountedAsThatAndSpoilsNothing) {
  MonteCarloLocalizer localizer = make(), undisturbed = make();
  drive(localizer, 0, 10);
  const double nan = std::nan("");
  EXPECT_EQ(localizer.process(changed_scan(0.93, [](LaserScan& s) { s.ranges_m.clear(); })),
            Outcome::kDroppedMalformed);
  EXPECT_EQ(localizer.process(changed_scan(0.93, [&](LaserScan& s) { s.angle_min_rad = nan; })),
            Outcome::kDroppedMalformed);
  EXPECT_EQ(localizer.process(odometry_event(0.95, {nan, 0, 0})), Outcome::kDroppedMalformed);
  EXPECT_EQ(localizer.process(odometry_event(0.95, {0, std::numeric_limits<double>::infinity(), 0})),
            Outcome::kDroppedMalformed);
  // The wrong kind for its stream.
  EXPECT_EQ(localizer.process(odometry_event(0.95, {}, 1)), Outcome::kDroppedUnboundStream);
  drive(localizer, 10, 30);
  localizer.finish();
  drive(undisturbed, 0, 30);
  undisturbed.finish();
  EXPECT_EQ(localizer.estimate()->T_map_base, undisturbed.estimate()->T_map_base);
  EXPECT_EQ(localizer.estimate()->covariance, undisturbed.estimate()->covariance);
  EXPECT_EQ(total(localizer), total(undisturbed) + 5);
}

TEST_P(LocalizerLaws, AScanWithoutAUsefulBeamLeavesTheEstimateFinite) {
  MonteCarloLocalizer localizer = make();
  for (int i = 0; i < 30; ++i) {
    localizer.process(odometry_event(0.1 * i, on_circle({}, 0.1 * i)));
    const Outcome outcome = localizer.process(changed_scan(0.1 * i, [&](LaserScan& s) {
      const float nothing = i % 2 == 0 ? kNan : 0.0f;
      std::fill(s.ranges_m.begin(), s.ranges_m.end(), nothing);
    }));
    EXPECT_NE(std::string(to_string(outcome)), "");
    if (localizer.estimate()) {
      ASSERT_TRUE(is_finite(localizer.estimate()->T_map_base));
      ASSERT_TRUE(localizer.estimate()->covariance.allFinite());
    }
  }
  localizer.finish();
  EXPECT_EQ(total(localizer), 60);
}

TEST_P(LocalizerLaws, FollowsTheRobotWithTheSameBytesForAnyNumberOfThreads) {
  std::vector<Estimate> ends;
  for (const int threads : {1, 2, 7}) {
    MonteCarloLocalizer localizer = make(threads);
    drive(localizer, 0, 60);
    localizer.finish();
    ends.push_back(*localizer.estimate());
    const Pose2 truth = on_circle(kStart, to_seconds(ends.back().stamp));
    EXPECT_LT(distance(ends.back().T_map_base, truth), 0.15);
    EXPECT_EQ(ends.back().T_map_base, ends[0].T_map_base);
    EXPECT_EQ(ends.back().covariance, ends[0].covariance);
    EXPECT_EQ(ends.back().ess, ends[0].ess);
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, LocalizerLaws, ::testing::ValuesIn(recipes()),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace cairn::test
