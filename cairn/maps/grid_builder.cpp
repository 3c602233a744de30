#include "cairn/maps/grid_builder.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace cairn {
namespace {

constexpr double kMaxCellIndex = 1e9;  // leaves room for sums of int
constexpr int kSpareCells = 200;       // grown beyond what is needed, so that growing is rare

int floor_to_int(double x) { return static_cast<int>(std::floor(x)); }

Point2 shortened(const Point2& from, const Point2& to, double length) {
  const double whole = std::hypot(to.x - from.x, to.y - from.y);
  if (length >= whole) return to;
  const double f = std::max(0.0, length) / whole;
  return {from.x + f * (to.x - from.x), from.y + f * (to.y - from.y)};
}

/// Steps from cell to cell along one axis of a beam.
struct BeamAxis {
  BeamAxis(double from, double to)
      : cell(floor_to_int(from)),
        steps_left(std::abs(floor_to_int(to) - cell)),
        direction(to < from ? -1 : 1) {
    if (steps_left == 0) return;
    cost = 1.0 / std::abs(to - from);
    next = cost * (direction > 0 ? cell + 1 - from : from - cell);
  }
  void step() {
    cell += direction;
    --steps_left;
    next = steps_left > 0 ? next + cost : std::numeric_limits<double>::infinity();
  }

  int cell;
  int steps_left;
  int direction;
  double cost = 0.0;                                      // share of the beam per cell
  double next = std::numeric_limits<double>::infinity();  // share of the beam at the next border
};

}  // namespace

void GridBuilderOptions::validate() const {
  const auto require = [](bool holds, const char* key, const char* remedy) {
    if (!holds) throw ConfigurationError(key, "is out of range", remedy);
  };
  require(resolution_m >= 1e-4 && resolution_m <= 100.0, "resolution_m", "give 0.0001 to 100 metres");
  require(max_range_m > 0.0, "max_range_m", "give metres greater than 0");
  require(uncleared_m >= 0.0 && std::isfinite(uncleared_m), "uncleared_m", "give metres, 0 or more");
  require(min_observations >= 1, "min_observations", "give 1 or more");
  require(occupied_share >= 0.0 && occupied_share < 1.0, "occupied_share", "give 0 or more, less than 1");
  require(free_share >= 0.0 && free_share <= occupied_share, "free_share", "give 0 to occupied_share");
  require(max_cells >= 1 && max_cells <= (std::size_t{1} << 31), "max_cells", "give 1 to 2^31");
}

GridBuilder::GridBuilder(const GridBuilderOptions& options) : options_(options) { options_.validate(); }

void GridBuilder::add(const Pose2& T_map_sensor, std::span<const Point2> end_points) {
  if (end_points.empty()) return;
  // From here on in cells of the map frame.
  const double scale = 1.0 / options_.resolution_m;
  const Point2 sensor{T_map_sensor.x * scale, T_map_sensor.y * scale};
  std::vector<Point2> ends;
  ends.reserve(end_points.size());
  for (const Point2& point : end_points) {
    const Point2 end = T_map_sensor * point;
    ends.push_back({end.x * scale, end.y * scale});
  }
  grow_to(extent_of(sensor, ends));
  ++scan_;
  count_hits(sensor, ends);
  for (const Point2& end : ends) count_misses(sensor, end);
}

GridBuilder::Extent GridBuilder::extent_of(const Point2& sensor, std::span<const Point2> ends) const {
  double min_x = sensor.x, max_x = sensor.x, min_y = sensor.y, max_y = sensor.y;
  bool is_sound = std::isfinite(sensor.x) && std::isfinite(sensor.y);
  for (const Point2& end : ends) {
    const Point2 used = shortened(sensor, end, options_.max_range_m / options_.resolution_m);
    is_sound = is_sound && std::isfinite(used.x) && std::isfinite(used.y);
    min_x = std::min(min_x, used.x), max_x = std::max(max_x, used.x);
    min_y = std::min(min_y, used.y), max_y = std::max(max_y, used.y);
  }
  is_sound = is_sound && std::max({-min_x, -min_y, max_x, max_y}) < kMaxCellIndex;
  if (!is_sound) {
    throw InputError("scan " + std::to_string(scan_ + 1), "its pose or a range is not finite or absurdly far",
                     "correct or leave out the scan");
  }
  // One cell more on each side: a shortened beam may come out a rounding error outside.
  return {{floor_to_int(min_x) - 1, floor_to_int(min_y) - 1},
          {floor_to_int(max_x) + 1, floor_to_int(max_y) + 1}};
}

void GridBuilder::grow_to(const Extent& wanted) {
  const Extent old = counts_.empty() ? wanted : extent_;
  const auto lower = [](int had, int want) { return want < had ? want - kSpareCells : had; };
  const auto upper = [](int had, int want) { return want > had ? want + kSpareCells : had; };
  const Extent grown{{lower(old.min.column, wanted.min.column), lower(old.min.row, wanted.min.row)},
                     {upper(old.max.column, wanted.max.column), upper(old.max.row, wanted.max.row)}};
  if (counts_.empty() || grown != extent_) move_counts_to(grown);
}

void GridBuilder::move_counts_to(const Extent& grown) {
  const std::size_t width = grown.width();
  if (width * grown.height() > options_.max_cells) {
    throw InputError(
        "scan " + std::to_string(scan_ + 1),
        "the map would grow to " + std::to_string(width) + " x " + std::to_string(grown.height()) + " cells",
        "look for a jump in the trajectory, use a coarser resolution or a smaller maximum range");
  }
  std::vector<Counts> counts(width * grown.height());
  const std::size_t old_width = extent_.width();
  for (std::size_t row = 0; row * old_width < counts_.size(); ++row) {
    const auto first_row = static_cast<std::size_t>(extent_.min.row - grown.min.row);
    const auto first_column = static_cast<std::size_t>(extent_.min.column - grown.min.column);
    std::copy_n(&counts_[row * old_width], old_width, &counts[(first_row + row) * width + first_column]);
  }
  extent_ = grown;
  counts_ = std::move(counts);
}

std::size_t GridBuilder::index_of(Cell cell) const {
  return static_cast<std::size_t>(cell.row - extent_.min.row) * extent_.width() +
         static_cast<std::size_t>(cell.column - extent_.min.column);
}

GridBuilder::Counts& GridBuilder::at(Cell cell) { return counts_[index_of(cell)]; }

void GridBuilder::count_hits(const Point2& sensor, std::span<const Point2> ends) {
  const double max_range = options_.max_range_m / options_.resolution_m;
  for (const Point2& end : ends) {
    if (std::hypot(end.x - sensor.x, end.y - sensor.y) > max_range) continue;
    Counts& counts = at({floor_to_int(end.x), floor_to_int(end.y)});
    if (counts.last_scan == scan_) continue;
    counts.last_scan = scan_;
    ++counts.hits;
  }
}

void GridBuilder::count_misses(const Point2& sensor, const Point2& end) {
  const double range = std::hypot(end.x - sensor.x, end.y - sensor.y);
  const double cleared = std::min(range - options_.uncleared_m / options_.resolution_m,
                                  options_.max_range_m / options_.resolution_m);
  if (cleared <= 0.0) return;
  const Point2 stop = shortened(sensor, end, cleared);
  BeamAxis x(sensor.x, stop.x), y(sensor.y, stop.y);
  count_miss({x.cell, y.cell});
  while (x.steps_left + y.steps_left > 0) {
    (x.next < y.next ? x : y).step();
    count_miss({x.cell, y.cell});
  }
}

void GridBuilder::count_miss(Cell cell) {
  Counts& counts = at(cell);
  if (counts.last_scan == scan_) return;
  counts.last_scan = scan_;
  ++counts.misses;
}

GridBuilder::Extent GridBuilder::observed() const {
  Extent seen{extent_.max, extent_.min};
  std::size_t index = 0;
  for (int row = extent_.min.row; row <= extent_.max.row; ++row) {
    for (int column = extent_.min.column; column <= extent_.max.column; ++column, ++index) {
      if (counts_[index].last_scan == 0) continue;
      seen.min = {std::min(seen.min.column, column), std::min(seen.min.row, row)};
      seen.max = {std::max(seen.max.column, column), std::max(seen.max.row, row)};
    }
  }
  return seen;
}

OccupancyGrid::Cell GridBuilder::percent(const Counts& counts) const {
  const std::uint32_t seen = counts.hits + counts.misses;
  if (seen < static_cast<std::uint32_t>(options_.min_observations)) return OccupancyGrid::kUnknown;
  return static_cast<OccupancyGrid::Cell>(std::lround(100.0 * counts.hits / seen));
}

OccupancyGrid GridBuilder::build() const {
  if (scan_ == 0)
    throw InputError("map", "no beam was returned by anything", "check the scans and their poses");
  const Extent seen = observed();
  GridGeometry geometry;
  geometry.width = static_cast<int>(seen.width());
  geometry.height = static_cast<int>(seen.height());
  geometry.resolution_m = options_.resolution_m;
  geometry.T_map_grid = {seen.min.column * options_.resolution_m, seen.min.row * options_.resolution_m, 0.0};
  std::vector<OccupancyGrid::Cell> cells;
  cells.reserve(geometry.size());
  for (int row = seen.min.row; row <= seen.max.row; ++row) {
    for (int column = seen.min.column; column <= seen.max.column; ++column) {
      cells.push_back(percent(counts_[index_of({column, row})]));
    }
  }
  return OccupancyGrid(geometry, std::move(cells), {options_.occupied_share, options_.free_share});
}

}  // namespace cairn
