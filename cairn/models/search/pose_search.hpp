#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cairn {

/// Axis-parallel rectangle of the map frame, metres.
struct MapRegion {
  Point2 lower;
  Point2 upper;
};

struct PoseSearchQuery {
  int most_poses = 10;           ///< distinct poses to find
  double separation_m = 1.0;     ///< poses nearer than this ...
  double separation_rad = 0.35;  ///< ... and turned by less than this are not distinct
  double margin = 1e9;           ///< poses whose log-likelihood is this far below the best are not looked for
  std::int64_t budget = 200'000'000;     ///< end points looked up; in sixteen boxes side by side: once
  std::optional<MapRegion> region = {};  ///< where the robot may be; nullopt: wherever the map is free
};

struct FoundPose {
  Pose2 T_map_base;
  double log_likelihood = 0.0;  ///< sum over the end points
};

struct PoseSearchResult {
  std::vector<FoundPose> poses;  ///< the best first; each the best of those distinct from all before it
  /// False if the budget ended the search: the poses are then good ones, but no longer proven to be the best.
  bool complete = true;
  std::int64_t evaluated = 0;      ///< end points looked up
  std::int64_t lattice_poses = 0;  ///< poses among which the search chose
};

/// Finds the poses that explain a set of end points best, anywhere on a map, by branch and bound: exhaustive
/// search over a lattice, without the parts that provably hold nothing better.
///
/// The lattice holds the centres of all free cells and headings so near to each other that nine of ten end
/// points move by less than a cell between two of them. A pose scores as in the likelihood field (Thrun et
/// al., Probabilistic Robotics, table 6.3): the sum over the end points of log(z_hit exp(-d^2 / (2
/// sigma_hit^2)) + z_rand). A box of 4^h x 4^h cells and 4^h headings cannot score better than the sum over
/// the end points of the best value in the window of cells that the point can reach; the box of the best
/// bound is divided next (Land & Doig 1960; on likelihood grids: Hess et al., ICRA 2016). The first undivided
/// pose is therefore the best of all.
///
/// Immutable: find() may be called from several threads at once.
class PoseSearch {
 public:
  /// Prepares the map: a few tens of milliseconds per million cells.
  /// @throws ConfigurationError if the map has no free cell
  PoseSearch(const OccupancyGrid& map, const LikelihoodFieldOptions& model);
  ~PoseSearch();
  PoseSearch(PoseSearch&&) noexcept;
  PoseSearch& operator=(PoseSearch&&) noexcept;

  /// @param points end points of beams in the robot's base frame, metres: of one scan, or of several joined
  /// by
  ///   odometry. Points that are not finite are left out. None: no pose is found.
  PoseSearchResult find(std::span<const Point2> points, const PoseSearchQuery& query) const;

  /// Log-likelihood of any pose, as in the search.
  double log_likelihood(std::span<const Point2> points, const Pose2& T_map_base) const;

 private:
  struct Map;
  std::unique_ptr<const Map> map_;
};

}  // namespace cairn
