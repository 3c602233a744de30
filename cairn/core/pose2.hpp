#pragma once

namespace cairn {

/// Point in a plane, metres.
struct Point2 {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// Rigid motion of the plane, an element of SE(2): position in metres, heading in radians in [-pi, pi).
///
/// `T_a_b` names a pose that takes coordinates in frame b to frame a, so that `T_a_c = T_a_b * T_b_c`
/// and `p_a = T_a_b * p_b`.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// Velocity of a body in its own frame, integrated over a time: the tangent of SE(2) (m, m, rad).
struct Twist2 {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
  friend bool operator==(const Twist2&, const Twist2&) = default;
};

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c);
Point2 operator*(const Pose2& T_a_b, const Point2& p_b);

/// `T_b_a` from `T_a_b`.
Pose2 inverse(const Pose2& T_a_b);

/// `T_from_to`: where `to` is, seen from `from` (both in the same frame).
Pose2 between(const Pose2& from, const Pose2& to);

/// Arc of constant twist: `exp(log(T)) == T` for |theta| < pi.
Pose2 exp(const Twist2& twist);
Twist2 log(const Pose2& T);

/// Point at `fraction` of the constant-twist arc from `from` to `to`. Fractions outside 0..1 extrapolate.
Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction);

/// Euclidean distance of the positions, metres.
double distance(const Pose2& a, const Pose2& b);

/// True if no coordinate is NaN or infinite.
bool is_finite(const Pose2& pose);

}  // namespace cairn
