#include "cairn/models/search/scan_signature.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

LaserScan scan_of_ranges(std::vector<float> ranges) {
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = kPi / static_cast<double>(ranges.size() - 1);
  scan.range_max_m = 50.0;
  scan.ranges_m = std::move(ranges);
  return scan;
}

TEST(ScanSignature, HoldsTheMedianOfEachSector) {
  std::vector<float> ranges(240, 3.0F);
  ranges[3] = 0.5F;  // one beam of ten on a leg
  for (std::size_t i = 120; i < 240; ++i) ranges[i] = 4.0F;
  const ScanSignature signature = signature_of(scan_of_ranges(ranges), {}, {});
  for (std::size_t s = 0; s < signature.size(); ++s) EXPECT_FLOAT_EQ(signature[s], s < 12 ? 3.0F : 4.0F) << s;
}

TEST(ScanSignature, WhatIsFarOrDoesNotReturnIsAtTheLargestRange) {
  std::vector<float> ranges(240, 30.0F);
  for (std::size_t i = 120; i < 240; ++i) ranges[i] = std::numeric_limits<float>::infinity();
  const ScanSignature signature = signature_of(scan_of_ranges(ranges), {}, {});
  for (const float s : signature) EXPECT_FLOAT_EQ(s, 10.0F);
}

TEST(ScanSignature, BearingsWrapAround) {
  const SignatureShape all_around{-kPi, kPi, 10.0};
  std::vector<double> bearings;
  std::vector<float> ranges;
  for (int i = 0; i < 720; ++i) {
    bearings.push_back(kTwoPi * (i + 0.5) / 720.0);  // 0 to 2 pi: beyond the last bearing, a turn further
    ranges.push_back(i < 360 ? 2.0F : 5.0F);
  }
  const ScanSignature signature = signature_of(bearings, ranges, all_around);
  for (std::size_t s = 0; s < signature.size(); ++s) EXPECT_FLOAT_EQ(signature[s], s < 12 ? 5.0F : 2.0F) << s;
}

TEST(ScanSignature, BeamsBeyondTheFieldOfViewAreLeftOut) {
  const std::vector<double> bearings = {0.0, 3.0, std::nan("")};
  const std::vector<float> ranges = {1.0F, 2.0F, 3.0F};
  const ScanSignature signature = signature_of(bearings, ranges, {-0.1, 0.1, 10.0});
  EXPECT_EQ(std::count(signature.begin(), signature.end(), 1.0F), 1);
  EXPECT_EQ(std::count(signature.begin(), signature.end(), 10.0F), 23);
}

TEST(ScanSignature, ShapesThatAreNone) {
  EXPECT_THROW((SignatureShape{1.0, 1.0, 10.0}.validate()), ConfigurationError);
  EXPECT_THROW((SignatureShape{0.0, 7.0, 10.0}.validate()), ConfigurationError);
  EXPECT_THROW((SignatureShape{0.0, 1.0, 0.0}.validate()), ConfigurationError);
  EXPECT_THROW((SignatureShape{std::nan(""), 1.0, 10.0}.validate()), ConfigurationError);
}

}  // namespace
}  // namespace cairn
