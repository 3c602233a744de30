#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cairn {

/// Shortest ways for a round robot on an occupancy grid: A* over the eight neighbours of each cell, then
/// every corner that can be cut is cut.
class RoutePlanner {
 public:
  /// @param clearance_m  that no point of a way comes nearer than to an occupied cell; at most 5 m
  RoutePlanner(const OccupancyGrid& grid, double clearance_m);

  /// True if the robot may stand there: on a free cell, far enough from everything.
  bool is_free(const Point2& point) const;

  /// True if it may drive straight from a to b.
  bool sees(const Point2& a, const Point2& b) const;

  /// True if there is a way from a to b; costs next to nothing.
  bool joins(const Point2& a, const Point2& b) const;

  /// Corners of the way without `from`, ending with `to`; nullopt if there is none.
  std::optional<std::vector<Point2>> route(const Point2& from, const Point2& to) const;

  double resolution_m() const { return geometry_.resolution_m; }

  /// Centres of all cells where the robot may stand, row by row.
  const std::vector<Point2>& free_points() const { return free_points_; }

 private:
  std::optional<std::size_t> cell_of(const Point2& point) const;
  bool is_open(int column, int row) const;
  template <class Visit>
  void for_each_neighbour(std::size_t cell, const Visit& visit) const;
  void label_parts();
  std::vector<Point2> trace(std::size_t goal, const std::vector<std::size_t>& from) const;
  std::vector<Point2> cut_corners(const Point2& from, std::vector<Point2> way) const;

  GridGeometry geometry_;
  std::vector<bool> open_;
  std::vector<std::uint32_t>
      part_;  // number of the connected part that an open cell belongs to, from 1; else 0
  std::vector<Point2> free_points_;
};

}  // namespace cairn
