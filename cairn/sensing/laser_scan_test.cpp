#include "cairn/sensing/laser_scan.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(LaserScan, ValidRangesLieInTheHalfOpenInterval) {
  LaserScan scan;
  scan.range_min_m = 0.5;
  scan.range_max_m = 8.0;
  for (const float range : {0.5f, 3.0f, 7.999f}) EXPECT_TRUE(scan.is_valid_range(range)) << range;
  for (const float range : {0.0f, 0.499f, 8.0f, 100.0f, -1.0f})
    EXPECT_FALSE(scan.is_valid_range(range)) << range;
}

TEST(LaserScan, WhatIsNoRangeIsNotValidWhateverTheLimits) {
  LaserScan scan;
  scan.range_min_m = -1.0;
  scan.range_max_m = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(scan.is_valid_range(1e-3f));
  for (const float range : {0.0f, -0.5f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_FALSE(scan.is_valid_range(range)) << range;
  }
}

}  // namespace
}  // namespace cairn
