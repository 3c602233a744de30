#include "cairn/models/search/scan_signature.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

// Medians of the sectors; a sector in which no beam looks sees nothing within reach.
class Sectors {
 public:
  explicit Sectors(const SignatureShape& shape) : shape_(shape) {}

  void add(double bearing_rad, double range_m) {
    const double width = (shape_.last_bearing_rad - shape_.first_bearing_rad) / SignatureShape::kSectors;
    double from_first = std::fmod(bearing_rad - shape_.first_bearing_rad, kTwoPi);
    if (from_first < -1e-9) from_first += kTwoPi;
    const auto sector = static_cast<std::size_t>(std::max(0.0, from_first) / width);
    // The last bearing belongs to the last sector.
    const bool on_the_edge =
        sector == SignatureShape::kSectors && from_first < width * (static_cast<double>(sector) + 1e-6);
    if (sector >= SignatureShape::kSectors && !on_the_edge) return;
    ranges_[std::min(sector, SignatureShape::kSectors - 1)].push_back(
        static_cast<float>(std::min(range_m, shape_.max_range_m)));
  }

  ScanSignature medians() {
    ScanSignature signature;
    for (std::size_t s = 0; s < ranges_.size(); ++s) {
      auto& ranges = ranges_[s];
      signature[s] = static_cast<float>(shape_.max_range_m);
      if (ranges.empty()) continue;
      const auto middle = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2);
      std::nth_element(ranges.begin(), middle, ranges.end());
      signature[s] = *middle;
    }
    return signature;
  }

 private:
  SignatureShape shape_;
  std::array<std::vector<float>, SignatureShape::kSectors> ranges_;
};

}  // namespace

void SignatureShape::validate() const {
  const double view = last_bearing_rad - first_bearing_rad;
  if (!(std::isfinite(first_bearing_rad) && view > 0.0 && view <= kTwoPi + 1e-6))
    throw ConfigurationError("field of view", "is empty or more than a full turn",
                             "give the first bearing and a later last one");
  if (!(max_range_m > 0.0 && max_range_m < 1e6))
    throw ConfigurationError("max_range_m", "is out of range", "give a positive number of metres");
}

ScanSignature signature_of(std::span<const double> bearings_rad, std::span<const float> ranges_m,
                           const SignatureShape& shape) {
  CAIRN_ASSERT(bearings_rad.size() == ranges_m.size());
  Sectors sectors(shape);
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (std::isfinite(bearings_rad[i]) && ranges_m[i] >= 0.0F) sectors.add(bearings_rad[i], ranges_m[i]);
  }
  return sectors.medians();
}

ScanSignature signature_of(const LaserScan& scan, const BeamLimits& limits, const SignatureShape& shape) {
  Sectors sectors(shape);
  for (const BeamReading& reading : select_readings(scan, limits, 0))
    sectors.add(reading.bearing_rad, reading.is_return ? reading.range_m : shape.max_range_m);
  return sectors.medians();
}

}  // namespace cairn
