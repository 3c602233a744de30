#pragma once

#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace cairn {

/// How a laser scan is brought to a few numbers that can be compared with those of other places.
struct SignatureShape {
  static constexpr std::size_t kSectors = 24;
  double first_bearing_rad = -1.5707963267948966;  ///< field of view, in the sensor's frame
  double last_bearing_rad = 1.5707963267948966;
  double max_range_m =
      10.0;  ///< longer ranges and missing returns count as this: what is far is seldom mapped well

  friend bool operator==(const SignatureShape&, const SignatureShape&) = default;
  /// @throws ConfigurationError unless first < last <= first + 2 pi and max_range_m > 0, all finite
  void validate() const;
};

/// Per sector of the field of view, from the first bearing to the last, the median range (m): a few beams on
/// people or chairs do not move it (sufficient statistics of a scan: Thrun, Fox, Burgard & Dellaert, "Robust
/// Monte Carlo localization for mobile robots", Artificial Intelligence 2001, section 4).
using ScanSignature = std::array<float, SignatureShape::kSectors>;

/// @param bearings_rad of the beams, in the sensor's frame; beams beyond the field of view are left out
/// @param ranges_m of each; what is not below shape.max_range_m counts as that
ScanSignature signature_of(std::span<const double> bearings_rad, std::span<const float> ranges_m,
                           const SignatureShape& shape);
/// Of a real scan, by the readings that select_readings() takes.
ScanSignature signature_of(const LaserScan& scan, const BeamLimits& limits, const SignatureShape& shape);

}  // namespace cairn
