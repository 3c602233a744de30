#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace cairn::test {

/// A grid from a drawing, its first line at the top: '#' occupied, ' ' free, '?' unknown.
inline OccupancyGrid draw_grid(const std::vector<std::string>& lines, double resolution_m = 1.0,
                               const Pose2& T_map_grid = {}) {
  std::vector<OccupancyGrid::Cell> cells;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    for (const char c : *line) cells.push_back(c == '#' ? 100 : (c == ' ' ? 0 : OccupancyGrid::kUnknown));
  }
  const auto width = static_cast<int>(lines.front().size());
  return {{width, static_cast<int>(lines.size()), resolution_m, T_map_grid}, std::move(cells)};
}

/// A room without symmetries, 8 m x 5 m at 5 cm: outer walls, a niche, two pillars, a short wall.
inline OccupancyGrid mini_room(const Pose2& T_map_grid = {}) {
  constexpr int kWidth = 160, kHeight = 100;
  std::vector<OccupancyGrid::Cell> cells(kWidth * kHeight, 0);
  const auto fill = [&](int column, int row, int width, int height) {
    for (int r = row; r < row + height; ++r) {
      for (int c = column; c < column + width; ++c) cells[static_cast<std::size_t>(r * kWidth + c)] = 100;
    }
  };
  fill(0, 0, kWidth, 1), fill(0, kHeight - 1, kWidth, 1);
  fill(0, 0, 1, kHeight), fill(kWidth - 1, 0, 1, kHeight);
  fill(110, 60, 50, 40);
  fill(30, 70, 6, 6), fill(70, 20, 4, 10);
  fill(0, 40, 25, 2);
  return {{kWidth, kHeight, 0.05, T_map_grid}, std::move(cells)};
}

/// A scan of `beams` evenly over the full circle, made by small steps along each beam up to the first
/// occupied cell; beams that leave the grid or exceed 20 m return nothing (0).
inline LaserScan scan_of(const OccupancyGrid& map, const Pose2& T_map_sensor, int beams) {
  LaserScan scan;
  scan.angle_min_rad = -3.14;
  scan.angle_increment_rad = 6.28 / beams;
  scan.range_min_m = 0.01;
  scan.range_max_m = 20.0;
  const double step = map.geometry().resolution_m / 50.0;
  for (int i = 0; i < beams; ++i) {
    const double angle = scan.angle_min_rad + i * scan.angle_increment_rad;
    double range = step;
    const auto hits = [&] {
      const Point2 end{range * std::cos(angle), range * std::sin(angle)};
      return map.state_at(T_map_sensor * end) == CellState::kOccupied;
    };
    while (range < scan.range_max_m && !hits()) range += step;
    scan.ranges_m.push_back(range < scan.range_max_m ? static_cast<float>(range) : 0.0f);
  }
  return scan;
}

}  // namespace cairn::test
