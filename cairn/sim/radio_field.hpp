#pragma once

#include "cairn/sim/sensor_options.hpp"
#include "cairn/sim/world_scene.hpp"

#include <array>
#include <cstdint>

namespace cairn {

/// A random field over the plane that is the same whenever one comes back to a place: Gaussian with mean
/// zero, and correlated as exp(-distance / shadowing_distance) (Gudmundson, "Correlation model for shadow
/// fading", 1991). It is a sum of cosines whose frequencies are drawn from the spectrum of that correlation,
/// a bivariate Cauchy distribution (Rahimi & Recht, "Random features", 2007).
class ShadowingField {
 public:
  /// @param number  fields of different numbers are independent
  ShadowingField(double sigma_db, double distance_m, std::uint64_t seed, std::uint64_t number);

  double at(const Point2& point) const;

 private:
  static constexpr std::size_t kWaves = 96;
  struct Wave {
    double x, y;  ///< frequency, rad/m
    double phase;
  };
  std::array<Wave, kWaves> waves_;
  double amplitude_db_;
};

/// Level at the receiver: `power_dbm` at one metre, path loss, a loss for everything on the line, without
/// shadowing and noise.
double received_level_dbm(const WorldScene& scene, const WorldRadioOptions& options,
                          const Point2& transmitter, double power_dbm, const Point2& receiver);

/// Walls and closed doors on the line that a radio wave goes through.
int walls_on_line(const WorldScene& scene, const Point2& from, const Point2& to);

/// What stands lower is not on the line between two antennas.
inline constexpr double kAntennaHeight_m = 1.0;

}  // namespace cairn
