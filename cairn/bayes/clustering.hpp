#pragma once

#include "cairn/core/pose2.hpp"

#include <span>
#include <vector>

namespace cairn {

struct ClusterOptions {
  double cell_m = 1.0;
  double cell_rad = 0.7854;       ///< rounded so that a whole number of cells fills the circle
  double min_cell_weight = 1e-3;  ///< share of the belief below which a cell joins nothing
};

/// Groups of weighted poses that hang together.
struct Clusters {
  std::vector<int> label;      ///< per pose: its cluster; -1 for poses in cells of no weight
  std::vector<double> weight;  ///< per cluster: share of the whole weight; the heaviest cluster first
};

/// Poses in the same or in neighbouring cells of a fixed (x, y, heading) grid belong together; the grid wraps
/// around in heading. The weights need not be normalised; their sum must be > 0.
Clusters cluster_poses(std::span<const Pose2> poses, std::span<const double> weights,
                       const ClusterOptions& options);

}  // namespace cairn
