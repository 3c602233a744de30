#include "cairn/maps/ray_marching.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_transform.hpp"
#include "cairn/maps/grid_ray_walk.hpp"
#include "cairn/maps/ray_marching_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kStepsPerCell = 1.0 / kCellsPerStep;
// Longer steps than 63 cells do not fit a byte.
constexpr int kLongestStep_cells = 63;
// Every step goes on by so much more, in cells, and by more than a float resolves in a large grid.
constexpr double kBeyond_cells = 1e-3;
constexpr double kBeyondPerSide = 0x1p-22;
constexpr std::uint32_t kLongestSide = 1 << 20;

constexpr double kLargestHeading = 1e5;  // beyond, angles are brought into [-pi, pi) first

// Every cell that ends a ray, and all of its neighbours: the distance to the next of these cells is how far a
// ray may go from anywhere in a cell, without entering a stop.
OccupancyGrid with_neighbours(const OccupancyGrid& grid, RayStop stop) {
  const GridGeometry& g = grid.geometry();
  std::vector<OccupancyGrid::Cell> cells(g.size(), 0);
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      if (!is_stop(grid.state(g.index(column, row)), stop)) continue;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, g.height - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, g.width - 1); ++c)
          cells[g.index(c, r)] = 100;
      }
    }
  }
  return {g, std::move(cells)};
}

}  // namespace

RayBearings::RayBearings(std::span<const double> bearings_rad)
    : radians_(bearings_rad.begin(), bearings_rad.end()) {
  for (const double bearing : radians_) {
    cosine_.push_back(static_cast<float>(std::cos(bearing)));
    sine_.push_back(static_cast<float>(std::sin(bearing)));
  }
}

struct RayMarcher::Place {
  std::size_t per_pose, per_bearing;
};

struct RayMarcher::Field {
  GridGeometry geometry;
  std::uint32_t columns;  ///< with a border of one cell
  std::uint32_t rows;
  std::vector<std::uint8_t> steps;

  std::size_t place(int column, int row) const {
    return (static_cast<std::size_t>(row) + 1) * columns + static_cast<std::size_t>(column) + 1;
  }
  std::uint8_t& step(int column, int row) { return steps[place(column, row)]; }
  std::uint8_t step(int column, int row) const { return steps[place(column, row)]; }
  bool ends(int column, int row) const { return step(column, row) == 0; }
  bool contains(const Point2& cell) const {
    return cell.x >= 0.0 && cell.x < geometry.width && cell.y >= 0.0 && cell.y < geometry.height;
  }
  // Cells between this one and the nearest of the border.
  int to_border(int column, int row) const {
    return std::min({column, geometry.width - 1 - column, row, geometry.height - 1 - row});
  }
  int step_at(const Point2& cell) const { return step(static_cast<int>(cell.x), static_cast<int>(cell.y)); }
  bool ends_at(const Point2& cell) const { return contains(cell) && step_at(cell) == 0; }
  RayOrigins origins_of(std::span<const Pose2> T_map_sensor) const;
};

RayMarcher::RayMarcher(const OccupancyGrid& grid, double max_range_m, RayStop stop)
    : max_range_m_(max_range_m) {
  if (!(max_range_m > 0.0)) {
    throw ConfigurationError("max_range_m", "is not positive", "give the scanner's range");
  }
  const GridGeometry& g = grid.geometry();
  Field field{g, static_cast<std::uint32_t>(g.width) + 2, static_cast<std::uint32_t>(g.height) + 2, {}};
  if (std::max(field.columns, field.rows) > kLongestSide || g.size() > std::size_t{1} << 30) {
    throw InputError("occupancy grid", "has more than 2^30 cells or is longer than 2^20",
                     "use larger cells, or a part of the map");
  }
  constexpr int kFar = kLongestStep_cells * kLongestStep_cells;
  const auto squared = truncated_squared_distances(with_neighbours(grid, stop), kFar, Executor());
  field.steps.resize(std::size_t{field.columns} * field.rows + 3);
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      const std::size_t i = g.index(column, row);
      const double cells = std::min<double>(std::sqrt(squared[i]), field.to_border(column, row));
      const auto safe = static_cast<std::uint8_t>(kStepsPerCell * cells);
      if (!is_stop(grid.state(i), stop)) field.step(column, row) = static_cast<std::uint8_t>(safe + 1);
    }
  }
  field_ = std::make_unique<const Field>(std::move(field));
}

RayMarcher::~RayMarcher() = default;
RayMarcher::RayMarcher(RayMarcher&&) noexcept = default;
RayMarcher& RayMarcher::operator=(RayMarcher&&) noexcept = default;

double RayMarcher::cell_m() const { return field_->geometry.resolution_m; }

void RayMarcher::cast(std::span<const Pose2> T_map_sensor, std::span<const double> bearings_rad,
                      std::span<float> ranges_m) const {
  CAIRN_ASSERT(ranges_m.size() == T_map_sensor.size() * bearings_rad.size());
  cast_blocks(T_map_sensor, RayBearings(bearings_rad), ranges_m.data(), {bearings_rad.size(), 1});
}

void RayMarcher::cast_by_bearing(std::span<const Pose2> T_map_sensor, const RayBearings& bearings,
                                 std::span<float> ranges_m) const {
  CAIRN_ASSERT(ranges_m.size() == T_map_sensor.size() * bearings.size());
  cast_blocks(T_map_sensor, bearings, ranges_m.data(), {1, T_map_sensor.size()});
}

void RayMarcher::cast_blocks(std::span<const Pose2> T_map_sensor, const RayBearings& bearings,
                             float* ranges_m, const Place& place) const {
  for (std::size_t begin = 0; begin < T_map_sensor.size(); begin += RayOrigins::kCapacity) {
    const std::size_t count = std::min(RayOrigins::kCapacity, T_map_sensor.size() - begin);
    cast_block(T_map_sensor.subspan(begin, count), bearings, ranges_m + begin * place.per_pose, place);
  }
}

// Those that a ray leaves at once have x = 0, in the border: poses off the map, in an obstacle, not finite.
RayOrigins RayMarcher::Field::origins_of(std::span<const Pose2> T_map_sensor) const {
  const Pose2 T_grid_map = inverse(geometry.T_map_grid);
  const double c = std::cos(T_grid_map.theta), s = std::sin(T_grid_map.theta);
  std::array<double, RayOrigins::kCapacity> headings{}, sines, cosines;
  for (std::size_t i = 0; i < T_map_sensor.size(); ++i) {
    const double heading = T_grid_map.theta + T_map_sensor[i].theta;
    headings[i] = std::abs(heading) < kLargestHeading ? heading : normalize_angle(heading);
  }
  sine_cosine_all(headings, sines, cosines);
  RayOrigins origins{};
  for (std::size_t i = 0; i < T_map_sensor.size(); ++i) {
    const Pose2& pose = T_map_sensor[i];
    const Point2 cell{(T_grid_map.x + c * pose.x - s * pose.y) / geometry.resolution_m,
                      (T_grid_map.y + s * pose.x + c * pose.y) / geometry.resolution_m};
    if (!contains(cell) || ends_at(cell) || !std::isfinite(pose.theta)) continue;
    origins.x[i] = static_cast<float>(cell.x + 1.0);
    origins.y[i] = static_cast<float>(cell.y + 1.0);
    origins.cosine[i] = static_cast<float>(cosines[i]);
    origins.sine[i] = static_cast<float>(sines[i]);
    origins.free[i] = kCellsPerStep * static_cast<float>(step_at(cell) - 1);
  }
  return origins;
}

void RayMarcher::cast_block(std::span<const Pose2> T_map_sensor, const RayBearings& bearings, float* ranges_m,
                            const Place& place) const {
  const Field& field = *field_;
  const RayOrigins origins = field.origins_of(T_map_sensor);
  const double side = std::max(field.columns, field.rows);
  const auto max_range = static_cast<float>(max_range_m_), metres = static_cast<float>(cell_m());
  const StepPlaneView plane{
      field.steps.data(), field.columns,
      field.rows,         static_cast<float>(std::max(kBeyond_cells, kBeyondPerSide * side)),
      max_range / metres, metres,
      max_range};
  std::array<float, RayOrigins::kCapacity> ranges;
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    march(plane, origins, bearings.cosine(k), bearings.sine(k), ranges);
    for (std::size_t i = 0; i < T_map_sensor.size(); ++i)
      ranges_m[i * place.per_pose + k * place.per_bearing] = ranges[i];
  }
  for (std::size_t i = 0; i < T_map_sensor.size(); ++i) {
    if (origins.x[i] == 0.0f)
      cast_exactly(T_map_sensor[i], bearings, ranges_m + i * place.per_pose, place.per_bearing);
  }
}

// A pose off the map, within an obstacle, or not finite: rare.
void RayMarcher::cast_exactly(const Pose2& pose, const RayBearings& bearings, float* ranges_m,
                              std::size_t per_bearing) const {
  const Field& field = *field_;
  const bool begins_within = field.ends_at(field.geometry.to_cells({pose.x, pose.y}));
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    const Pose2 ray{pose.x, pose.y, pose.theta + bearings.radians()[k]};
    bool is_within = begins_within;
    const auto stops = [&](int column, int row) {
      const bool ends = field.ends(column, row);
      is_within = is_within && ends;
      return ends && !is_within;
    };
    ranges_m[k * per_bearing] = static_cast<float>(walk_ray(field.geometry, ray, max_range_m_, stops));
  }
}

}  // namespace cairn
