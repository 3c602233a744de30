#include "cairn/maps/ndt_map.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cairn {
namespace {

constexpr std::size_t kMostCells = 50'000'000;
constexpr double kSmallestCell_m = 0.05, kLargestCell_m = 10.0;
constexpr double kPassSigmas = 2.0;  // a uniform stretch of wall reaches 1.7 standard deviations

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw InputError("NDT map", what, remedy);
}

void check_geometry(const NdtGeometry& g) {
  if (!(g.cell_size_m >= kSmallestCell_m && g.cell_size_m <= kLargestCell_m))
    refuse("cells are not 0.05 to 10 m wide", "0.2 to 0.5 m are good values");
  if (!is_finite(g.T_map_ndt)) refuse("origin is not finite", "correct it");
  if (g.columns <= 0 || g.rows <= 0) refuse("has no cells", "give it points");
  const double size = static_cast<double>(NdtGeometry::kLayers) * g.columns * static_cast<double>(g.rows);
  if (size > static_cast<double>(kMostCells)) refuse("has too many cells", "make them larger");
}

void check_cell(const NdtCell& c, const NdtGeometry& g) {
  if (c.index >= g.size()) refuse("a cell lies outside", "correct its index");
  const bool finite = std::isfinite(c.mean.x) && std::isfinite(c.mean.y) && std::isfinite(c.points);
  if (!finite || !(c.xx > 0.0 && c.yy > 0.0 && c.xx * c.yy - c.xy * c.xy > 0.0) ||
      !std::isfinite(c.xx * c.yy))
    refuse("a cell holds no normal distribution", "make the map anew");
  if (!(c.occupancy >= 0.0 && c.occupancy <= 1.0)) refuse("an occupancy is not within 0..1", "correct it");
}

// Sums of the points of each cell, relative to the cell's first point: differences of large numbers would
// lose the covariance.
struct Sums {
  double n = 0.0, weight = 0.0;
  Point2 first;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Point2& p, double occupancy) {
    if (n == 0.0) first = p;
    const double dx = p.x - first.x, dy = p.y - first.y;
    n += 1.0, weight += occupancy;
    x += dx, y += dy, xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
};

class Accumulator {
 public:
  Accumulator(const NdtGeometry& geometry, const NdtMapOptions& options)
      : geometry_(geometry), options_(options) {
    check_geometry(geometry);
    sums_.resize(geometry.size());
  }

  void add(const Point2& p_ndt, double occupancy) {
    for (int layer = 0; layer < NdtGeometry::kLayers; ++layer) {
      const std::ptrdiff_t index = geometry_.index(layer, p_ndt);
      if (index >= 0) sums_[static_cast<std::size_t>(index)].add(p_ndt, occupancy);
    }
  }

  NdtMap build() const {
    std::vector<NdtCell> cells;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      if (sums_[i].n >= std::max(1, options_.min_points)) cells.push_back(cell_of(i));
    }
    return {geometry_, std::move(cells)};
  }

 private:
  NdtCell cell_of(std::size_t index) const {
    const Sums& s = sums_[index];
    const double mx = s.x / s.n, my = s.y / s.n;
    const double noise = std::max(options_.noise_m * options_.noise_m, 1e-8);
    return {.index = static_cast<std::uint32_t>(index),
            .points = s.n,
            .mean = {s.first.x + mx, s.first.y + my},
            .xx = std::max(0.0, s.xx / s.n - mx * mx) + noise,
            .xy = s.xy / s.n - mx * my,
            .yy = std::max(0.0, s.yy / s.n - my * my) + noise,
            .occupancy = std::clamp(s.weight / s.n, 0.0, 1.0)};
  }

  NdtGeometry geometry_;
  NdtMapOptions options_;
  std::vector<Sums> sums_;
};

int cells_across(double length_m, double cell_size_m) {
  const double cells = std::floor(length_m / cell_size_m + 0.5) + 1.0;
  return cells < 1e6 ? static_cast<int>(cells) : 1'000'000;
}

// Around the points, with the origin on a multiple of the cell size.
NdtGeometry geometry_around(std::span<const Point2> points, double cell_size_m) {
  if (points.empty()) refuse("no point to build from", "give scans with returns");
  Point2 low = points[0], high = points[0];
  for (const Point2& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) refuse("a point is not finite", "leave it out");
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double x = std::floor(low.x / cell_size_m) * cell_size_m;
  const double y = std::floor(low.y / cell_size_m) * cell_size_m;
  return {
      {x, y, 0.0}, cell_size_m, cells_across(high.x - x, cell_size_m), cells_across(high.y - y, cell_size_m)};
}

// Beams into and through each distribution.
class OccupancyCounter {
 public:
  explicit OccupancyCounter(const NdtMap& map)
      : map_(map), hits_(map.cells().size(), 0.0), misses_(hits_), last_beam_(hits_.size(), 0) {}

  void count(const Point2& from, const Point2& to) {
    ++beam_;
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    for (const std::int32_t n : map_.around(to)) {
      if (n != NdtMap::kNone && is_new(n)) hits_[static_cast<std::size_t>(n)] += 1.0;
    }
    const double step = map_.geometry().cell_size_m / 4.0;  // no cell of any layer is stepped over by much
    for (double done = 0.0; done < length; done += step) {
      const double share = done / length;
      const Point2 p{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
      for (const std::int32_t n : map_.around(p)) {
        if (n != NdtMap::kNone && is_new(n) && passes(map_.cells()[static_cast<std::size_t>(n)], from, to))
          misses_[static_cast<std::size_t>(n)] += 1.0;
      }
    }
  }

  NdtMap result() const {
    std::vector<NdtCell> cells = map_.cells();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (hits_[i] > 0.0) cells[i].occupancy = hits_[i] / (hits_[i] + misses_[i]);
    }
    return {map_.geometry(), std::move(cells)};
  }

 private:
  bool is_new(std::int32_t n) {
    const bool first = last_beam_[static_cast<std::size_t>(n)] != beam_;
    last_beam_[static_cast<std::size_t>(n)] = beam_;
    return first;
  }

  // Close to the mean, at the closest point of the beam in the sense of the
  // distribution (Saarinen et al., "Normal Distributions Transform Occupancy Maps", ICRA 2013).
  static bool passes(const NdtCell& c, const Point2& from, const Point2& to) {
    const double determinant = c.xx * c.yy - c.xy * c.xy;
    const auto product = [&](const Point2& a, const Point2& b) {
      return (a.x * (c.yy * b.x - c.xy * b.y) + a.y * (c.xx * b.y - c.xy * b.x)) / determinant;
    };
    const Point2 along{to.x - from.x, to.y - from.y}, away{c.mean.x - from.x, c.mean.y - from.y};
    const double t = std::clamp(product(along, away) / product(along, along), 0.0, 1.0);
    const Point2 rest{away.x - t * along.x, away.y - t * along.y};
    return product(rest, rest) <= kPassSigmas * kPassSigmas;
  }

  const NdtMap& map_;
  std::vector<double> hits_, misses_;
  std::vector<std::uint64_t> last_beam_;
  std::uint64_t beam_ = 0;
};

}  // namespace

NdtMap::NdtMap(const NdtGeometry& geometry, std::vector<NdtCell> cells)
    : geometry_(geometry), cells_(std::move(cells)) {
  check_geometry(geometry_);
  numbers_.assign(geometry_.size(), kNone);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    check_cell(cells_[i], geometry_);
    if (i > 0 && cells_[i].index <= cells_[i - 1].index) refuse("cells are out of order", "sort them");
    numbers_[cells_[i].index] = static_cast<std::int32_t>(i);
  }
}

NdtMap ndt_from_points(std::span<const Point2> points_map, const NdtMapOptions& options) {
  const NdtGeometry geometry = geometry_around(points_map, options.cell_size_m);
  Accumulator accumulator(geometry, options);
  const Pose2 T_ndt_map = inverse(geometry.T_map_ndt);
  for (const Point2& p : points_map) accumulator.add(T_ndt_map * p, 1.0);
  return accumulator.build();
}

NdtMap ndt_from_grid(const OccupancyGrid& grid, const NdtMapOptions& options) {
  const GridGeometry& g = grid.geometry();
  const NdtGeometry geometry{g.T_map_grid, options.cell_size_m,
                             cells_across(g.width * g.resolution_m, options.cell_size_m),
                             cells_across(g.height * g.resolution_m, options.cell_size_m)};
  // A grid's cell is a square, not a point: its own variance belongs to the wall.
  NdtMapOptions noisy = options;
  noisy.noise_m = std::hypot(options.noise_m, g.resolution_m / std::sqrt(12.0));
  Accumulator accumulator(geometry, noisy);
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      const std::size_t i = g.index(column, row);
      if (grid.state(i) != CellState::kOccupied) continue;
      accumulator.add({(column + 0.5) * g.resolution_m, (row + 0.5) * g.resolution_m},
                      grid.cells()[i] / 100.0);
    }
  }
  NdtMap map = accumulator.build();
  if (map.cells().empty()) refuse("the grid has no walls", "check its thresholds");
  return map;
}

NdtMap ndt_from_scans(std::span<const NdtScan> scans, const NdtMapOptions& options) {
  std::vector<Point2> points;
  for (const NdtScan& scan : scans) {
    for (const Point2& p : scan.end_points) points.push_back(scan.T_map_sensor * p);
  }
  const NdtMap map = ndt_from_points(points, options);
  const Pose2 T_ndt_map = inverse(map.geometry().T_map_ndt);
  OccupancyCounter counter(map);
  for (const NdtScan& scan : scans) {
    const Pose2 T_ndt_sensor = T_ndt_map * scan.T_map_sensor;
    for (const Point2& p : scan.end_points) counter.count({T_ndt_sensor.x, T_ndt_sensor.y}, T_ndt_sensor * p);
  }
  return counter.result();
}

}  // namespace cairn
