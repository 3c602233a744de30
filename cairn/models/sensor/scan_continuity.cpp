#include "cairn/models/sensor/scan_continuity.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cairn {
namespace {

double squared(const Point2& p) { return p.x * p.x + p.y * p.y; }

// Not where the motion is no number.
bool is_within(const Pose2& T, double most_m, double most_rad) {
  return std::hypot(T.x, T.y) <= most_m && std::abs(normalize_angle(T.theta)) <= most_rad;
}

constexpr double kClose_m[] = {0.05, 0.1, 0.2, 0.4};  // each counts for a quarter

struct Turn {
  double cosine, sine;
};

// What counts lies within a few beams: there by their series, right to 1e-9, in a quarter of the time.
Turn turn(double angle) {
  if (std::abs(angle) > 0.2) return {std::cos(angle), std::sin(angle)};
  const double a = angle * angle;
  return {1.0 - a * (1.0 / 2 - a * (1.0 / 24 - a / 720)), angle * (1.0 - a * (1.0 / 6 - a / 120))};
}

// Of the line from a to b to the origin.
double squared_distance_to_line(const Point2& a, const Point2& b) {
  const Point2 along{b.x - a.x, b.y - a.y};
  const double u = std::clamp(-(a.x * along.x + a.y * along.y) / squared(along), 0.0, 1.0);
  return squared({a.x + u * along.x, a.y + u * along.y});
}

/// What a scan saw, beam by beam: end points, joined where they are neighbours.
class Outline {
 public:
  Outline(const LaserScan& scan, const BeamLimits& limits, double gap_m)
      : scan_(scan),
        limits_(limits),
        step_rad_(std::abs(scan.angle_increment_rad)),
        count_(static_cast<std::int64_t>(scan.ranges_m.size())),
        round_(step_rad_ * static_cast<double>(count_) > kTwoPi - 0.5 * step_rad_),
        gap2_(gap_m * gap_m) {}

  enum class Look { kOnIt, kOffIt, kOutOfView };

  /// Whether a point in the sensor's frame, `range` away, lies on it.
  Look look(const Point2& p, double range, double tolerance_m) const {
    const double place = place_of(std::atan2(p.y, p.x));
    // Not a number, where a scan's bearings are none.
    if (!(place >= 0.0) || (!round_ && place > static_cast<double>(count_ - 1))) return Look::kOutOfView;
    const auto middle = static_cast<std::int64_t>(place);
    const double reach =
        range > tolerance_m ? std::asin(tolerance_m / range) / step_rad_ : 0.5 * static_cast<double>(count_);
    const auto most = static_cast<std::int64_t>(std::min(reach + 1.0, 0.5 * static_cast<double>(count_)));
    bool seen = false;
    for (std::int64_t k = 0; k <= most; ++k) {  // the nearest first: most points lie there
      if (near(middle + k, place, range, tolerance_m, seen) ||
          near(middle - k, place, range, tolerance_m, seen))
        return Look::kOnIt;
    }
    return seen ? Look::kOffIt : Look::kOutOfView;
  }

  /// How near it lies to a point in the sensor's frame: 1 within the least of kClose_m, a quarter less for
  /// each of the others; nullopt: out of view.
  std::optional<double> closeness(const Point2& p) const {
    const double range = std::sqrt(squared(p));
    double closeness = 1.0;
    for (const double within_m : kClose_m) {
      const Look found = look(p, range, within_m);
      if (found == Look::kOutOfView) return std::nullopt;
      if (found == Look::kOnIt) return closeness;
      closeness -= 0.25;
    }
    return 0.0;
  }

 private:
  // The beam, as a fraction, that looks at a bearing.
  double place_of(double bearing) const {
    const double turned = (bearing - scan_.angle_min_rad) * (scan_.angle_increment_rad < 0.0 ? -1.0 : 1.0);
    return (turned - kTwoPi * std::floor(turned / kTwoPi)) / step_rad_;
  }

  // End point of a beam, seen from the point at `range` in the direction `place`, whose axis points outwards.
  std::optional<Point2> end(std::int64_t beam, double place, double range) const {
    if (round_) beam = (beam % count_ + count_) % count_;
    if (beam < 0 || beam >= count_) return std::nullopt;
    const float r = scan_.ranges_m[static_cast<std::size_t>(beam)];
    if (!scan_.is_valid_range(r) || r < limits_.min_range_m || r >= limits_.max_range_m) return std::nullopt;
    const auto [cosine, sine] = turn((static_cast<double>(beam) - place) * step_rad_);
    return Point2{r * cosine - range, r * sine};
  }

  // Whether the end point of a beam, or the line to the next one, passes through the point.
  bool near(std::int64_t beam, double place, double range, double tolerance_m, bool& seen) const {
    const auto here = end(beam, place, range);
    if (!here) return false;
    seen = true;
    const double tolerance2 = tolerance_m * tolerance_m;
    if (squared(*here) < tolerance2) return true;
    const auto next = end(beam + 1, place, range);
    if (!next) return false;
    const double apart2 = squared({next->x - here->x, next->y - here->y});
    return apart2 > 0.0 && apart2 < gap2_ && squared_distance_to_line(*here, *next) < tolerance2;
  }

  const LaserScan& scan_;
  const BeamLimits& limits_;
  double step_rad_;
  std::int64_t count_;
  bool round_;  // looks all around: the last beam is beside the first
  double gap2_;
};

}  // namespace

bool ScanContinuity::can_tell(const LaserScan& scan) const {
  return std::abs(scan.angle_increment_rad) * static_cast<double>(scan.ranges_m.size()) >=
         options_.least_view_rad;
}

std::optional<double> ScanContinuity::share(const LaserScan& before, const LaserScan& now,
                                            const Pose2& T_before_now) const {
  if (!is_within(T_before_now, options_.most_m, options_.most_rad)) return std::nullopt;
  const std::optional<double> forth = share_on(before, now, T_before_now);
  if (!forth || *forth >= options_.doubt) return forth;
  return std::min(*forth, share_on(now, before, inverse(T_before_now)).value_or(1.0));
}

std::optional<double> ScanContinuity::closeness(const LaserScan& before, const LaserScan& now,
                                                const Pose2& T_before_now) const {
  if (!is_within(T_before_now, options_.most_compared_m, options_.most_compared_rad)) return std::nullopt;
  const Pose2 T_sensor_base = inverse(T_base_sensor_) * T_before_now;
  const Outline outline(before, limits_, options_.gap_m);
  int in_view = 0;
  double sum = 0.0;
  for (const Point2& end : select_end_points(now, T_base_sensor_, limits_, options_.compared_beams)) {
    const std::optional<double> close = outline.closeness(T_sensor_base * end);
    in_view += close.has_value();
    sum += close.value_or(0.0);
  }
  if (in_view < options_.least_beams) return std::nullopt;
  return sum / in_view;
}

// Of `scan`, on what was seen in `seen`.
std::optional<double> ScanContinuity::share_on(const LaserScan& seen, const LaserScan& scan,
                                               const Pose2& T_seen_scan) const {
  const double way_m = std::hypot(T_seen_scan.x, T_seen_scan.y);
  const double turn_rad = std::abs(normalize_angle(T_seen_scan.theta));
  const Pose2 T_sensor_base = inverse(T_base_sensor_) * T_seen_scan;
  const Outline outline(seen, limits_, options_.gap_m);
  int in_view = 0, on_it = 0;
  for (const Point2& end : select_end_points(scan, T_base_sensor_, limits_, options_.beams)) {
    const Point2 p = T_sensor_base * end;
    const double range_m = std::sqrt(squared(p));
    const double tolerance_m = options_.tolerance_m + options_.per_way * way_m +
                               (options_.per_range + options_.per_turn * turn_rad) * range_m;
    const Outline::Look look = outline.look(p, range_m, tolerance_m);
    in_view += look != Outline::Look::kOutOfView;
    on_it += look == Outline::Look::kOnIt;
  }
  if (in_view < options_.least_beams) return std::nullopt;
  return static_cast<double>(on_it) / in_view;
}

}  // namespace cairn
