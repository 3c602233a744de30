#pragma once

#include "cairn/maps/occupancy_grid.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cairn {

/// The default shares are those with which single scans, started 8 cm off, fall back to their reference pose
/// best (likelihood field of 0.1 m, two real buildings): mean 3.9 and 4.3 cm; 4.0 and 5.9 cm with an
/// occupied_share of 0.3, 5.3 and 6.4 cm with 0.4. A reference that is good to 2-4 cm spreads a wall over two
/// cells, which share its hits.
struct GridBuilderOptions {
  double resolution_m = 0.05;
  /// A beam clears cells up to this range; beyond it there is neither clearing nor a hit.
  double max_range_m = std::numeric_limits<double>::infinity();
  /// The last metres before an end point are not cleared: range noise and the thickness of a wall must not
  /// wipe out the wall itself.
  double uncleared_m = 0.05;
  int min_observations = 1;             ///< scans that must have seen a cell; else it stays unknown
  double occupied_share = 0.1;          ///< occupied if hits / (hits + misses) exceeds this ...
  double free_share = 0.1;              ///< ... free below this, unknown between
  std::size_t max_cells = 100'000'000;  ///< of the whole extent; 12 bytes each while building

  /// @throws ConfigurationError for values out of range
  void validate() const;
};

/// Builds an occupancy grid from range scans whose poses are known, by counting reflections: the probability
/// of a cell is hits / (hits + misses) (Haehnel, Triebel, Burgard, Thrun, "Map building with mobile
/// robots in dynamic environments", ICRA 2003).
///
/// What is counted are scans, not beams (Hornung et al., "OctoMap", 2013): a scan that has an end point in a
/// cell is one hit there, and its other beams that cross the cell count for nothing; else a scan with any
/// beam across the cell is one miss. So the many beams that graze a wall do not outvote the few that end on
/// it, and cells near the scanner are not overcounted. Beams are followed through every cell that they touch
/// (Amanatides & Woo 1987). The extent grows as needed; cell borders lie on multiples of the resolution.
class GridBuilder {
 public:
  explicit GridBuilder(const GridBuilderOptions& options = {});

  /// One scan, taken at `T_map_sensor`. `end_points` are the places where beams were reflected, in the
  /// sensor's frame, metres. Beams without a return must be left out: they prove nothing free.
  /// @throws InputError if the pose or a point is not finite, or the map would exceed `max_cells`; the map
  ///   is as before
  void add(const Pose2& T_map_sensor, std::span<const Point2> end_points);

  /// The map of what was added so far: the smallest rectangle around the observed cells.
  /// @throws InputError if nothing was observed
  OccupancyGrid build() const;

  std::int64_t scans() const { return scan_; }

 private:
  struct Cell {
    int column = 0;
    int row = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  /// Cells from `min` to `max`, both included.
  struct Extent {
    Cell min;
    Cell max;
    std::size_t width() const { return static_cast<std::size_t>(max.column - min.column) + 1; }
    std::size_t height() const { return static_cast<std::size_t>(max.row - min.row) + 1; }
    friend bool operator==(const Extent&, const Extent&) = default;
  };
  struct Counts {
    std::uint32_t hits = 0;
    std::uint32_t misses = 0;
    std::uint32_t last_scan = 0;  ///< that counted here
  };

  Extent extent_of(const Point2& sensor, std::span<const Point2> ends) const;
  void grow_to(const Extent& wanted);
  void move_counts_to(const Extent& grown);
  std::size_t index_of(Cell cell) const;
  Counts& at(Cell cell);
  void count_hits(const Point2& sensor, std::span<const Point2> ends);
  void count_misses(const Point2& sensor, const Point2& end);
  void count_miss(Cell cell);
  Extent observed() const;
  OccupancyGrid::Cell percent(const Counts& counts) const;

  GridBuilderOptions options_;
  Extent extent_;  ///< of counts_, in cells of the map frame
  std::vector<Counts> counts_;
  std::uint32_t scan_ = 0;
};

}  // namespace cairn
