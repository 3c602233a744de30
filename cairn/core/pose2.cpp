#include "cairn/core/pose2.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {
namespace {

// sin(a)/a and (1-cos(a))/a, the latter as 2 sin(a/2)^2/a: 1-cos(a) would lose the digits of small angles.
struct ArcFactors {
  double along;
  double across;
};

ArcFactors arc_factors(double angle) {
  if (angle == 0.0) return {1.0, 0.0};
  const double half = std::sin(angle / 2.0);
  return {std::sin(angle) / angle, 2.0 * half * half / angle};
}

}  // namespace

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Point2 p = T_a_b * Point2{T_b_c.x, T_b_c.y};
  return {p.x, p.y, normalize_angle(T_a_b.theta + T_b_c.theta)};
}

Point2 operator*(const Pose2& T_a_b, const Point2& p_b) {
  const double c = std::cos(T_a_b.theta);
  const double s = std::sin(T_a_b.theta);
  return {T_a_b.x + c * p_b.x - s * p_b.y, T_a_b.y + s * p_b.x + c * p_b.y};
}

Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.theta);
  const double s = std::sin(T_a_b.theta);
  return {-c * T_a_b.x - s * T_a_b.y, s * T_a_b.x - c * T_a_b.y, normalize_angle(-T_a_b.theta)};
}

Pose2 between(const Pose2& from, const Pose2& to) { return inverse(from) * to; }

Pose2 exp(const Twist2& twist) {
  const auto [along, across] = arc_factors(twist.theta);
  return {along * twist.x - across * twist.y, across * twist.x + along * twist.y,
          normalize_angle(twist.theta)};
}

Twist2 log(const Pose2& T) {
  const auto [along, across] = arc_factors(T.theta);
  const double det = along * along + across * across;
  return {(along * T.x + across * T.y) / det, (-across * T.x + along * T.y) / det, T.theta};
}

Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction) {
  const Twist2 whole = log(between(from, to));
  return from * exp({fraction * whole.x, fraction * whole.y, fraction * whole.theta});
}

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

}  // namespace cairn
