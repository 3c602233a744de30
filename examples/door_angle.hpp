// How far is the door open? The models of the example door_angle.cpp.
//
// The hinge is the origin, the wall runs along x, the leaf opens away from the robot: at angle a it ends at
// (cos a, sin a) times its width. The robot stands before the wall and looks at the leaf with range beams.
#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/angle.hpp"

#include <cmath>
#include <vector>

namespace door {

/// Opening angle: 0 is closed, pi / 2 is wide open.
struct Opening {
  double rad = 0.0;
};

constexpr double kWidest_rad = cairn::kPi / 2.0;
constexpr double kLeaf_m = 0.9;
constexpr double kFar_m = 4.0;  ///< what a beam measures that misses the leaf

/// People push the door now and then: a random walk between the stops. The control is the time, in seconds.
class PushedDoor final : public cairn::MotionModel<Opening, double> {
 public:
  explicit PushedDoor(double rad_per_sqrt_s) : rad_per_sqrt_s_(rad_per_sqrt_s) {}

  void propagate(const double& seconds, std::span<Opening> doors,
                 const cairn::RandomStream& random) const override {
    const double sigma = rad_per_sqrt_s_ * std::sqrt(seconds);
    for (std::size_t i = 0; i < doors.size(); ++i)
      doors[i].rad = reflected(doors[i].rad + sigma * random.normal4(static_cast<std::uint32_t>(i))[0]);
  }

 private:
  // At both stops.
  static double reflected(double rad) { return std::abs(std::remainder(rad, 2.0 * kWidest_rad)); }

  double rad_per_sqrt_s_;
};

/// A beam from `origin` (metres) with direction (cos, sin) of `heading_rad`, and what it measured.
struct Beam {
  cairn::Point2 origin;
  double heading_rad = 0.0;
  double range_m = 0.0;
};

/// Distance along the beam to the leaf, kFar_m if it misses.
inline double expected_range_m(const Beam& beam, const Opening& opening) {
  const double lx = kLeaf_m * std::cos(opening.rad), ly = kLeaf_m * std::sin(opening.rad);
  const double dx = std::cos(beam.heading_rad), dy = std::sin(beam.heading_rad);
  // origin + r d = s l, by Cramer's rule
  const double determinant = lx * dy - ly * dx;
  const double s = (beam.origin.x * dy - beam.origin.y * dx) / determinant;
  const double r = (beam.origin.x * ly - beam.origin.y * lx) / determinant;
  const bool hits = std::isfinite(s) && s >= 0.0 && s <= 1.0 && r >= 0.0;
  return hits ? std::fmin(r, kFar_m) : kFar_m;
}

/// p(z | a): mostly Gaussian around the expected range, sometimes anything up to kFar_m.
class BeamOnDoor final : public cairn::SensorModel<Opening, Beam> {
 public:
  explicit BeamOnDoor(double sigma_m) : sigma_m_(sigma_m) {}

  cairn::BoundUpdate<Opening> bind(const Beam& z) const override {
    return {{}, [z, sigma = sigma_m_](std::span<const Opening> doors, std::span<double> out) {
              for (std::size_t i = 0; i < doors.size(); ++i) {
                const double error = (z.range_m - expected_range_m(z, doors[i])) / sigma;
                const double gaussian = std::exp(-0.5 * error * error) / (sigma * std::sqrt(cairn::kTwoPi));
                out[i] = std::log(0.9 * gaussian + 0.1 / kFar_m);
              }
            }};
  }

 private:
  double sigma_m_;
};

}  // namespace door
