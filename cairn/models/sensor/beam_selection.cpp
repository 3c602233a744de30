#include "cairn/models/sensor/beam_selection.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/batch_math.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kLargestBearing = 1e5;  // beyond, angles are brought into [-pi, pi] first

// Of `available` things, the middle of each of at most `wanted` (0: all) equal shares.
class EvenChoice {
 public:
  EvenChoice(std::size_t available, int wanted)
      : available_(available),
        count_(wanted > 0 ? std::min(static_cast<std::size_t>(wanted), available) : available) {}
  std::size_t count() const { return count_; }
  std::size_t operator[](std::size_t k) const { return (2 * k + 1) * available_ / (2 * count_); }

 private:
  std::size_t available_;
  std::size_t count_;
};

template <class Keep>
std::vector<std::size_t> beams_that(const LaserScan& scan, const Keep& keep) {
  std::vector<std::size_t> beams;
  beams.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (keep(scan.ranges_m[i])) beams.push_back(i);
  }
  return beams;
}

double bearing_of(const LaserScan& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.angle_increment_rad;
}

}  // namespace

std::vector<std::size_t> select_beams(const LaserScan& scan, const BeamLimits& limits, int max_beams) {
  const std::vector<std::size_t> valid = beams_that(scan, [&](float range) {
    return scan.is_valid_range(range) && range >= limits.min_range_m && range < limits.max_range_m;
  });
  const EvenChoice chosen(valid.size(), max_beams);
  std::vector<std::size_t> beams(chosen.count());
  for (std::size_t k = 0; k < chosen.count(); ++k) beams[k] = valid[chosen[k]];
  return beams;
}

std::vector<Point2> select_end_points(const LaserScan& scan, const Pose2& T_base_sensor,
                                      const BeamLimits& limits, int max_beams) {
  const std::vector<std::size_t> beams = select_beams(scan, limits, max_beams);
  const std::size_t count = beams.size();
  std::vector<double> numbers(3 * count);
  const auto angles = std::span(numbers).first(count);
  const auto sines = std::span(numbers).subspan(count, count), cosines = std::span(numbers).last(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = bearing_of(scan, beams[k]);
    angles[k] = std::abs(angle) < kLargestBearing ? angle : std::remainder(angle, kTwoPi);
  }
  sine_cosine_all(angles, sines, cosines);
  const double c = std::cos(T_base_sensor.theta), s = std::sin(T_base_sensor.theta);
  std::vector<Point2> points(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double range = scan.ranges_m[beams[k]];
    const double ahead = range * cosines[k], aside = range * sines[k];
    points[k] = {T_base_sensor.x + c * ahead - s * aside, T_base_sensor.y + s * ahead + c * aside};
  }
  return points;
}

double reach_m(const LaserScan& scan, const BeamLimits& limits) {
  return std::min(scan.range_max_m, limits.max_range_m);
}

std::vector<BeamReading> select_readings(const LaserScan& scan, const BeamLimits& limits, int max_beams) {
  const double least = std::max(scan.range_min_m, limits.min_range_m);
  const double reach = reach_m(scan, limits);
  const std::vector<std::size_t> telling =
      beams_that(scan, [&](float range) { return range > 0.0f && range >= least; });
  const EvenChoice chosen(telling.size(), max_beams);
  std::vector<BeamReading> readings;
  readings.reserve(chosen.count());
  for (std::size_t k = 0; k < chosen.count(); ++k) {
    const double range = scan.ranges_m[telling[chosen[k]]];
    readings.push_back({bearing_of(scan, telling[chosen[k]]), std::min(range, reach), range < reach});
  }
  return readings;
}

}  // namespace cairn
