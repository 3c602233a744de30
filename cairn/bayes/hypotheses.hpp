#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace cairn {

struct HypothesisOptions {
  double cell_m = 2.0;          ///< sides of the grid in which particles are gathered first
  double cell_rad = 0.7853982;  ///< 45 degrees; rounded so that a whole number of cells fills the circle
  double fuse_m = 1.5;          ///< groups whose means are nearer than this ...
  double fuse_rad = 0.5;        ///< ... and turned by less than this are one
  /// Or nearer than so many times the sum of their standard deviations: a belief wider than a cell is cut by
  /// the grid, and its pieces are no hypotheses.
  double fuse_sigmas = 2.5;
  double valley = 0.5;  ///< what is close to two groups joins them if it has this share of the lighter peak
  double significance = 0.01;  ///< groups below this share of the heaviest one are not significant

  void visit(OptionVisitor& visitor);
};

/// A place where the robot may be.
struct PoseHypothesis {
  double weight = 0.0;                                   ///< share of the whole belief
  Pose2 mean;                                            ///< of this group alone; heading on the circle
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of this group alone: (x, y, theta), m, rad
  std::size_t particles = 0;
};

struct PoseHypotheses {
  std::vector<PoseHypothesis> found;  ///< the significant ones, the heaviest first; at least one
  std::vector<int> label;  ///< per pose: index into `found`, -1 for groups that are not significant
};

/// Groups of weighted poses (Sehestedt & Schneider, ICINCO 2006, section 5.2): particles in one cell of a
/// fixed grid over x, y and heading belong together; groups that are close in all three are fused;
/// groups of low weight are not significant. Headings wrap around. The weights need not be normalised; their
/// sum must be > 0. O(N log N + G^2) for G occupied cells of significant weight.
PoseHypotheses find_hypotheses(std::span<const Pose2> poses, std::span<const double> weights,
                               const HypothesisOptions& options);

}  // namespace cairn
