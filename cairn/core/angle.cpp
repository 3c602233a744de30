#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {

double normalize_angle(double radians) {
  if (radians >= -kPi && radians < kPi) return radians;
  const double wrapped = std::remainder(radians, kTwoPi);  // [-pi, pi], exact
  return wrapped >= kPi ? -kPi : wrapped;
}

double angle_difference(double to, double from) { return normalize_angle(to - from); }

double interpolate_angle(double from, double to, double fraction) {
  return normalize_angle(from + fraction * angle_difference(to, from));
}

}  // namespace cairn
