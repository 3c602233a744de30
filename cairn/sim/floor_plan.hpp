#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <vector>

namespace cairn {

/// Straight piece of a wall, opaque from both sides; metres, map frame.
struct Segment {
  Point2 a;
  Point2 b;
};

/// Upright cylinder, opaque: a person, a pillar.
struct Cylinder {
  Point2 center;
  double radius_m = 0.0;
};

/// Rectangle along the axes of the map.
struct Rectangle {
  Point2 min;
  Point2 max;

  Point2 center() const { return {0.5 * (min.x + max.x), 0.5 * (min.y + max.y)}; }
};

/// What a planar laser can hit.
struct FloorPlan {
  std::vector<Segment> walls;
  std::vector<Cylinder> cylinders;
};

/// The four sides of the rectangle.
void add_outline(const Rectangle& rectangle, std::vector<Segment>& walls);

/// Smallest distance between the point and any point of the segment, metres.
double distance(const Point2& point, const Segment& segment);

/// Draws the walls (not the cylinders) into a grid of square cells.
///
/// A cell that a wall passes through is occupied (100), the cells that can be reached from `inside` without
/// crossing a wall are free (0), all others are unknown. Points whose coordinates are multiples of the
/// resolution lie at cell centres, so that such walls are drawn without rounding. `margin_m` of unknown cells
/// surround the walls.
/// @throws ConfigurationError if there is no wall, or `inside` lies in or beyond one
OccupancyGrid rasterize(const FloorPlan& plan, const Point2& inside, double resolution_m,
                        double margin_m = 0.5);

}  // namespace cairn
