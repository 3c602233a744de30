#include "cairn/maps/ray_marching.hpp"

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

struct RayMarcher::Field {
  GridGeometry geometry;
  std::uint32_t columns;  ///< with a border of one cell
  std::uint32_t rows;
  std::vector<std::uint8_t> steps;

  std::uint8_t& step(int column, int row) {
    return steps[(static_cast<std::size_t>(row) + 1) * columns + static_cast<std::size_t>(column) + 1];
  }
  bool ends(int column, int row) const {
    return steps[(static_cast<std::size_t>(row) + 1) * columns + static_cast<std::size_t>(column) + 1] == 0;
  }
  bool contains(const Point2& cell) const {
    return cell.x >= 0.0 && cell.x < geometry.width && cell.y >= 0.0 && cell.y < geometry.height;
  }
  bool ends_at(const Point2& cell) const {
    return contains(cell) && ends(static_cast<int>(cell.x), static_cast<int>(cell.y));
  }
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
      const auto safe = static_cast<std::uint8_t>(kStepsPerCell * std::sqrt(squared[i]));
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
  for (std::size_t begin = 0; begin < T_map_sensor.size(); begin += RayOrigins::kCapacity) {
    const std::size_t count = std::min(RayOrigins::kCapacity, T_map_sensor.size() - begin);
    cast_block(T_map_sensor.subspan(begin, count), bearings_rad,
               ranges_m.subspan(begin * bearings_rad.size(), count * bearings_rad.size()));
  }
}

void RayMarcher::cast_block(std::span<const Pose2> T_map_sensor, std::span<const double> bearings_rad,
                            std::span<float> ranges_m) const {
  const Field& field = *field_;
  const Pose2 T_grid_map = inverse(field.geometry.T_map_grid);
  const double cell_m = field.geometry.resolution_m;
  RayOrigins origins{};  // the unused ones stand in the border, where every ray ends at once
  for (std::size_t i = 0; i < T_map_sensor.size(); ++i) {
    const Pose2 T_grid_sensor = T_grid_map * T_map_sensor[i];
    const Point2 cell{T_grid_sensor.x / cell_m, T_grid_sensor.y / cell_m};
    if (!field.contains(cell) || field.ends_at(cell) || !std::isfinite(T_grid_sensor.theta)) continue;
    origins.x[i] = static_cast<float>(cell.x + 1.0);
    origins.y[i] = static_cast<float>(cell.y + 1.0);
    origins.cosine[i] = static_cast<float>(std::cos(T_grid_sensor.theta));
    origins.sine[i] = static_cast<float>(std::sin(T_grid_sensor.theta));
  }
  std::array<float, RayOrigins::kCapacity> cells;
  const double side = std::max(field.columns, field.rows);
  const StepPlaneView plane{field.steps.data(), field.columns, field.rows,
                            static_cast<float>(std::max(kBeyond_cells, kBeyondPerSide * side))};
  const auto max_range = static_cast<float>(max_range_m_), metres = static_cast<float>(cell_m);
  for (std::size_t k = 0; k < bearings_rad.size(); ++k) {
    march(plane, origins, static_cast<float>(std::cos(bearings_rad[k])),
          static_cast<float>(std::sin(bearings_rad[k])), max_range / metres, cells);
    for (std::size_t i = 0; i < T_map_sensor.size(); ++i)
      ranges_m[i * bearings_rad.size() + k] = cells[i] < max_range / metres ? cells[i] * metres : max_range;
  }
  for (std::size_t i = 0; i < T_map_sensor.size(); ++i) {
    if (origins.x[i] == 0.0f)
      cast_exactly(T_map_sensor[i], bearings_rad,
                   ranges_m.subspan(i * bearings_rad.size(), bearings_rad.size()));
  }
}

// A pose off the map, within an obstacle, or not finite: rare.
void RayMarcher::cast_exactly(const Pose2& pose, std::span<const double> bearings_rad,
                              std::span<float> ranges_m) const {
  const Field& field = *field_;
  const bool begins_within = field.ends_at(field.geometry.to_cells({pose.x, pose.y}));
  for (std::size_t k = 0; k < bearings_rad.size(); ++k) {
    const Pose2 ray{pose.x, pose.y, pose.theta + bearings_rad[k]};
    bool is_within = begins_within;
    const auto stops = [&](int column, int row) {
      const bool ends = field.ends(column, row);
      is_within = is_within && ends;
      return ends && !is_within;
    };
    ranges_m[k] = static_cast<float>(walk_ray(field.geometry, ray, max_range_m_, stops));
  }
}

}  // namespace cairn
