#pragma once

#include <numbers>

namespace cairn {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// The same angle in [-pi, pi). Finite input of any magnitude; NaN and infinity give NaN.
double normalize_angle(double radians);

/// Signed shortest turn from `from` to `to`, in [-pi, pi).
double angle_difference(double to, double from);

/// Point at `fraction` (0..1) of the shortest turn from `from` to `to`, in [-pi, pi).
double interpolate_angle(double from, double to, double fraction);

constexpr double degrees_to_radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double radians_to_degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace cairn
