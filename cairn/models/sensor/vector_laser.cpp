#include "cairn/models/sensor/vector_laser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace cairn {
namespace {

constexpr double kExplained_m = 0.15;
constexpr double kEverything_m = 1e9;
constexpr double kNarrowest = 1e-9;  // turn of a piece; narrower ones come and go with rounding
// The direction of the scan at an end point is that between points this far to both sides.
constexpr double kHalfBase_m = 0.15;
constexpr double kSmallestGap_m = 0.3;  // between neighbours of one surface; wider where beams are sparse
constexpr double kGapsPerSpacing = 4.0;

struct Beam {
  Point2 direction;  ///< unit length, base frame
  double range_m;
  std::optional<Point2> tangent;  ///< of the scan there, unit length, base frame
};

// A scan as the evaluation needs it.
struct PreparedScan {
  Point2 sensor;  ///< base frame
  std::vector<Beam> beams;
  double scale = 1.0;
};

// A beam and the nearest piece of a wall that is seen about its end point.
struct Correspondence {
  Point2 end;         ///< end point relative to the base, map frame's axes
  Point2 away;        ///< from the wall to the end point, unit length; zero if it lies on the wall
  double distance_m;  ///< of the end point to the piece
  bool before_wall;
  bool gated;  ///< near its wall and running along it
};

Point2 rotate(double c, double s, const Point2& p) { return {c * p.x - s * p.y, s * p.x + c * p.y}; }
double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }

Point2 end_point(const LaserScan& scan, std::size_t i) {
  const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
  return {scan.ranges_m[i] * std::cos(angle), scan.ranges_m[i] * std::sin(angle)};
}

// The last point of the same surface as beam `i`, up to kHalfBase_m away, in one direction of indices.
Point2 follow_surface(const LaserScan& scan, std::size_t i, int step) {
  const Point2 start = end_point(scan, i);
  const double spacing = std::abs(scan.angle_increment_rad) * scan.ranges_m[i];
  const double gap = std::max(kSmallestGap_m, kGapsPerSpacing * spacing);
  Point2 last = start;
  const auto count = static_cast<std::ptrdiff_t>(scan.ranges_m.size());
  for (auto j = static_cast<std::ptrdiff_t>(i) + step; j >= 0 && j < count; j += step) {
    const auto next = static_cast<std::size_t>(j);
    if (!scan.is_valid_range(scan.ranges_m[next])) break;
    const Point2 p = end_point(scan, next);
    if (std::hypot(p.x - last.x, p.y - last.y) > gap) break;
    last = p;
    if (std::hypot(p.x - start.x, p.y - start.y) >= kHalfBase_m) break;
  }
  return last;
}

std::optional<Point2> tangent_at(const LaserScan& scan, std::size_t i) {
  const Point2 a = follow_surface(scan, i, -1), b = follow_surface(scan, i, 1);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < kHalfBase_m) return std::nullopt;
  return Point2{(b.x - a.x) / length, (b.y - a.y) / length};
}

PreparedScan prepare(const LaserScan& scan, const Pose2& T_base_sensor, const BeamLimits& limits,
                     const VectorLaserOptions& o) {
  PreparedScan prepared{{T_base_sensor.x, T_base_sensor.y}, {}, 1.0};
  const double c = std::cos(T_base_sensor.theta), s = std::sin(T_base_sensor.theta);
  for (const std::size_t i : select_beams(scan, limits, o.max_beams)) {
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    std::optional<Point2> tangent = tangent_at(scan, i);
    if (tangent) tangent = rotate(c, s, *tangent);
    prepared.beams.push_back({rotate(c, s, {std::cos(angle), std::sin(angle)}), scan.ranges_m[i], tangent});
  }
  const double beams = std::max<double>(1.0, static_cast<double>(prepared.beams.size()));
  prepared.scale = std::min(1.0, o.effective_beams / beams);
  return prepared;
}

// Calls `visit(piece)` for each piece seen between two turns, counter-clockwise from the first to the second.
template <class Visit>
void for_each_between(const std::vector<VisiblePiece>& pieces, double from, double to, const Visit& visit) {
  if (!(from <= to)) {  // across the turn where counting begins; or not a number
    if (from > to) for_each_between(pieces, from, 8.0, visit), for_each_between(pieces, 0.0, to, visit);
    return;
  }
  const auto ends_before = [&](const VisiblePiece& piece) { return piece.turn_end <= from; };
  auto piece = std::partition_point(pieces.begin(), pieces.end(), ends_before);
  for (; piece != pieces.end() && piece->turn_begin <= to; ++piece) visit(*piece);
}

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

// What an end point is compared with: what is seen between two directions beside it.
struct Window {
  Point2 viewpoint, end;          ///< map frame
  Point2 right, left, direction;  ///< seen from the viewpoint
};

// The part of a piece within the window, as fractions of the way from its begin to its end.
std::pair<double, double> part_within(const VisiblePiece& piece, const Window& w) {
  const Point2 a{piece.begin.x - w.viewpoint.x, piece.begin.y - w.viewpoint.y};
  const Point2 b{piece.end.x - w.viewpoint.x, piece.end.y - w.viewpoint.y};
  const double right_a = cross(w.right, a), right_b = cross(w.right, b);
  const double left_a = cross(w.left, a), left_b = cross(w.left, b);
  return {right_a < 0.0 && right_b > 0.0 ? right_a / (right_a - right_b) : 0.0,
          left_a < 0.0 && left_b > 0.0 ? left_a / (left_a - left_b) : 1.0};
}

// Takes the piece into the correspondence if it is the nearest so far.
void match(const VisiblePiece& piece, const Window& w, const Beam& beam, const Point2& tangent,
           const VectorLaserOptions& o, Correspondence& found) {
  if (!(piece.turn_end - piece.turn_begin > kNarrowest)) return;
  const Point2 d{piece.end.x - piece.begin.x, piece.end.y - piece.begin.y};
  const Point2& p = w.end;
  const double length2 = dot(d, d);
  if (!(length2 > 0.0)) return;
  const auto [first, last] = part_within(piece, w);
  const double foot = dot({p.x - piece.begin.x, p.y - piece.begin.y}, d) / length2;
  const double along = std::min(std::max(foot, first), last);
  const Point2 offset{p.x - piece.begin.x - along * d.x, p.y - piece.begin.y - along * d.y};
  const double distance = std::hypot(offset.x, offset.y);
  if (!(distance < found.distance_m)) return;
  found.distance_m = distance;
  found.away = distance > 0.0 ? Point2{offset.x / distance, offset.y / distance} : Point2{};
  found.before_wall = dot(offset, w.direction) < 0.0;
  const double cosine = beam.tangent ? std::abs(dot(tangent, d)) / std::sqrt(length2) : -1.0;
  found.gated = distance <= o.gate_m && cosine >= std::cos(o.gate_rad);
}

// Calls `visit(correspondence or nullptr)` for each beam of the scan seen from a pose.
template <class Visit>
void for_each_beam(const PreparedScan& scan, const Pose2& T_map_base, const VectorLaserOptions& o,
                   VisibilityRenderer& renderer, const Visit& visit) {
  const double c = std::cos(T_map_base.theta), s = std::sin(T_map_base.theta);
  const Point2 lever = rotate(c, s, scan.sensor);
  const Point2 viewpoint{T_map_base.x + lever.x, T_map_base.y + lever.y};
  const std::vector<VisiblePiece>& pieces = renderer.render(viewpoint, kEverything_m);
  for (const Beam& beam : scan.beams) {
    const Point2 u = rotate(c, s, beam.direction), tangent = rotate(c, s, beam.tangent.value_or(Point2{}));
    const Point2 end{beam.range_m * u.x, beam.range_m * u.y}, aside{-o.margin_m * u.y, o.margin_m * u.x};
    Correspondence found{
        {lever.x + end.x, lever.y + end.y}, {}, std::numeric_limits<double>::infinity(), false, false};
    const Window window{viewpoint,
                        {viewpoint.x + end.x, viewpoint.y + end.y},
                        {end.x - aside.x, end.y - aside.y},
                        {end.x + aside.x, end.y + aside.y},
                        u};
    for_each_between(pieces, turn_of(window.right), turn_of(window.left),
                     [&](const VisiblePiece& piece) { match(piece, window, beam, tangent, o, found); });
    visit(std::isfinite(found.distance_m) ? &found : nullptr);
  }
}

// log(exp(-r^2 / (2 sigma^2)) + exp(-c^2 / (2 sigma^2))) and how much of it is the first term.
struct Hit {
  Hit(double residual, double cap, double sigma) {
    const double a = -residual * residual / (2.0 * sigma * sigma), b = -cap * cap / (2.0 * sigma * sigma);
    const double larger = std::max(a, b), sum = std::exp(a - larger) + std::exp(b - larger);
    log_likelihood = larger + std::log(sum);
    share = std::exp(a - larger) / sum;
  }
  double log_likelihood, share;
};

Hit hit_of(const Correspondence& found, const VectorLaserOptions& o) {
  return {found.distance_m, found.before_wall ? o.obstacle_m : o.short_hit_m, o.sigma_m};
}

double log_likelihood_at(const PreparedScan& scan, const Pose2& T_map_base, const VectorLaserOptions& o,
                         VisibilityRenderer& renderer) {
  const double none = -o.out_of_range_m * o.out_of_range_m / (2.0 * o.sigma_m * o.sigma_m);
  double sum = 0.0;
  for_each_beam(scan, T_map_base, o, renderer, [&](const Correspondence* found) {
    sum += found == nullptr ? none : hit_of(*found, o).log_likelihood;
  });
  return scan.scale * sum;
}

Eigen::Vector3d gradient_at(const PreparedScan& scan, const Pose2& T_map_base, const VectorLaserOptions& o,
                            VisibilityRenderer& renderer) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for_each_beam(scan, T_map_base, o, renderer, [&](const Correspondence* found) {
    if (found == nullptr || !found->gated) return;
    const double slope = -hit_of(*found, o).share * found->distance_m / (o.sigma_m * o.sigma_m);
    // Turning by dtheta moves the end point by dtheta times its lever, turned left.
    const double turning = dot(found->away, {-found->end.y, found->end.x});
    sum += slope * Eigen::Vector3d(found->away.x, found->away.y, turning);
  });
  return scan.scale * sum;
}

}  // namespace

void VectorLaserOptions::visit(OptionVisitor& v) {
  const Range length{1e-3, 100.0};
  v.number(
      {"sigma_m", "standard deviation of the end points' distance to the wall that is seen there, metres"},
      sigma_m, length);
  v.number({"obstacle_m", "a beam that ends before its wall counts for no more than this far off it, metres"},
           obstacle_m, length);
  v.number({"short_hit_m", "likewise a beam that ends behind its wall, metres"}, short_hit_m, length);
  v.number({"out_of_range_m", "likewise a beam in whose direction the map has no wall, metres"},
           out_of_range_m, length);
  v.number(
      {"margin_m", "end points correspond to walls that are seen within this far to their sides, metres"},
      margin_m, length);
  v.number({"gate_m", "the gradient uses end points up to this far off their wall, metres"}, gate_m, length);
  v.number({"gate_rad", "and up to this angle between the directions of scan and wall, radians"}, gate_rad,
           {0.0, 1.6});
  v.integer({"max_beams", "evaluated beams per scan, spread evenly over the valid ones; 0: all"}, max_beams,
            {0, 100000});
  v.number({"effective_beams", "a scan never counts for more than this many independent beams"},
           effective_beams, {1e-4, 100000});
}

VectorLaser::VectorLaser(std::shared_ptr<const WallGrid> walls, const Pose2& T_base_sensor,
                         const BeamLimits& limits, const VectorLaserOptions& options)
    : walls_(std::move(walls)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

BoundUpdate<Pose2> VectorLaser::bind(const LaserScan& scan) const {
  const auto prepared =
      std::make_shared<const PreparedScan>(prepare(scan, T_base_sensor_, limits_, options_));
  const auto log_likelihood = [prepared, walls = walls_, o = options_](std::span<const Pose2> states,
                                                                       std::span<double> out) {
    VisibilityRenderer renderer(*walls);
    for (std::size_t i = 0; i < states.size(); ++i) {
      out[i] = log_likelihood_at(*prepared, states[i], o, renderer);
    }
  };
  const auto gradient = [prepared, walls = walls_, o = options_](std::span<const Pose2> states,
                                                                 std::span<Eigen::Vector3d> out) {
    VisibilityRenderer renderer(*walls);
    for (std::size_t i = 0; i < states.size(); ++i) {
      out[i] = gradient_at(*prepared, states[i], o, renderer);
    }
  };
  return {.stamp = scan.stamp, .log_likelihood = log_likelihood, .gradient = gradient};
}

double VectorLaser::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const PreparedScan prepared = prepare(scan, T_base_sensor_, limits_, options_);
  VisibilityRenderer renderer(*walls_);
  std::size_t explained = 0;
  for_each_beam(prepared, T_map_base, options_, renderer, [&](const Correspondence* found) {
    explained += found != nullptr && found->distance_m <= kExplained_m ? 1 : 0;
  });
  return prepared.beams.empty() ? 0.0
                                : static_cast<double>(explained) / static_cast<double>(prepared.beams.size());
}

}  // namespace cairn
