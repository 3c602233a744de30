#include "cairn/core/angle.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Angle, PlusPiIsMinusPi) {
  EXPECT_EQ(normalize_angle(kPi), -kPi);
  EXPECT_EQ(normalize_angle(-kPi), -kPi);
  EXPECT_EQ(normalize_angle(std::nextafter(kPi, 0.0)), std::nextafter(kPi, 0.0));
  EXPECT_EQ(normalize_angle(3.0 * kPi), -kPi);
  EXPECT_EQ(normalize_angle(-3.0 * kPi), -kPi);
}

TEST(Angle, JustBelowMinusPiComesInAtTheOtherEnd) {
  const double wrapped = normalize_angle(std::nextafter(-kPi, -4.0));
  EXPECT_LT(wrapped, kPi);
  EXPECT_NEAR(wrapped, kPi, 1e-15);
}

TEST(Angle, SmallAnglesStayTheSameBits) {
  for (const double a : {0.0, 1e-300, -1e-17, 1.0, -3.0}) EXPECT_EQ(normalize_angle(a), a);
}

TEST(Angle, AnyMagnitudeKeepsItsDirection) {
  for (const double a : {4.0, -4.0, 100.0, -12345.678, 1e6, -1e9, 1e15}) {
    const double wrapped = normalize_angle(a);
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LT(wrapped, kPi);
    // kTwoPi is not exactly 2 pi: over a / kTwoPi turns the direction drifts by that much.
    const double drift = std::abs(a) / kTwoPi * 2.5e-16 + 1e-15;
    EXPECT_NEAR(std::cos(wrapped), std::cos(a), drift) << a;
    EXPECT_NEAR(std::sin(wrapped), std::sin(a), drift) << a;
  }
  for (const double a : {1e100, -1e300, std::numeric_limits<double>::max()}) {
    EXPECT_LE(std::abs(normalize_angle(a)), kPi) << a;
  }
}

TEST(Angle, NotANumberStaysNotANumber) {
  EXPECT_TRUE(std::isnan(normalize_angle(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(normalize_angle(kInfinity)));
  EXPECT_TRUE(std::isnan(normalize_angle(-kInfinity)));
}

TEST(Angle, DifferenceIsTheShortestTurn) {
  EXPECT_NEAR(angle_difference(3.0, -3.0), 6.0 - kTwoPi, 1e-15);
  EXPECT_NEAR(angle_difference(-3.0, 3.0), kTwoPi - 6.0, 1e-15);
  EXPECT_EQ(angle_difference(1.5, 1.0), 0.5);
  EXPECT_EQ(angle_difference(kPi / 2.0, -kPi / 2.0), -kPi);  // half a turn counts as clockwise
}

TEST(Angle, InterpolationCrossesPiAndMeetsItsEnds) {
  EXPECT_NEAR(interpolate_angle(3.0, -3.0, 0.5), -kPi, 1e-15);
  EXPECT_NEAR(interpolate_angle(3.0, -3.0, 0.25), 3.0 + 0.25 * (kTwoPi - 6.0), 1e-15);
  EXPECT_EQ(interpolate_angle(3.0, -3.0, 0.0), 3.0);
  EXPECT_NEAR(interpolate_angle(3.0, -3.0, 1.0), -3.0, 1e-15);
}

TEST(Angle, Degrees) {
  EXPECT_DOUBLE_EQ(degrees_to_radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(radians_to_degrees(-kPi / 2.0), -90.0);
}

}  // namespace
}  // namespace cairn
