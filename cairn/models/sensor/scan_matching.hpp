#pragma once

#include "cairn/bayes/linearised.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/wall_distance.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <functional>
#include <memory>
#include <optional>

#include <Eigen/Core>

namespace cairn {

struct ScanMatchingOptions {
  double sigma_m = 0.05;          ///< distance of end points to the mapped wall, standard deviation
  double outlier_m = 0.1;         ///< from about here on a point counts for less the farther off it is
  double gate_m = 0.5;            ///< points farther from any wall are left out
  int max_beams = 60;             ///< evaluated beams, spread evenly over the valid ones; 0: all
  double effective_beams = 20.0;  ///< a scan never counts for more than this many independent beams
};

/// Distance of a point (map frame, metres) to the nearest wall, and its slope.
struct WallOffset {
  double distance_m;
  Point2 slope;  ///< derivative of the distance by x and y, map frame
};
/// nullopt where there is no wall within reach, and for what is not finite.
using DistanceToWall = std::function<std::optional<WallOffset>(const Point2& p_map)>;

/// Of a grid's walls: bilinear between the centres of the cells, going on beyond the outermost ones. The
/// slope is that of the interpolation.
DistanceToWall distance_to_cells(std::shared_ptr<const DistanceField> field);
/// Of the walls of a vector map: exact.
DistanceToWall distance_to_walls(std::shared_ptr<const WallDistance> walls);

/// A scan matched against the map, as Kalman filters want it: one number per beam, the distance of its end
/// point to the nearest wall. It should be 0 (z); at the state it is d (z_hat); H is its slope by x, y and
/// heading, which is a point-to-line distance's where the wall is straight. The noise is
///   R = diag(sigma^2 (1 + (d / outlier)^2) / s),  s = min(1, effective_beams / K)
/// Cauchy's weights: a point that is off by more than the noise says less, so that people and changed
/// furniture do not pull; K end points lie on the same few walls and share the errors of the map.
///
/// The normal equations H'R^-1 H and H'R^-1 (z - z_hat) are those of iterative closest lines (Chen & Medioni
/// 1991; Censi, "An ICP variant using a point-to-line metric", ICRA 2008) with the map's field in place of
/// the search.
class ScanMatching final : public Linearises<Pose2, 3, LaserScan> {
 public:
  /// @param T_base_sensor where the scanner sits on the robot
  ScanMatching(DistanceToWall distance, const Pose2& T_base_sensor, const BeamLimits& limits,
               const ScanMatchingOptions& options);

  /// States are T_map_base. As many rows as beams end within gate_m of a wall; none for a state that is not
  /// finite.
  Linearised<3> linearise(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  DistanceToWall distance_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  ScanMatchingOptions options_;
};

/// A Gaussian belief of a pose, covariance of (x, y, heading) in metres and radians.
struct GaussianPose {
  Pose2 mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// The pose after a measurement, linearised again about each new mean until it rests (iterated extended
/// Kalman filter: Bell & Cathey 1993; Gauss-Newton on the sum of both). A wide prior makes it plain scan
/// matching. nullopt if the measurement says nothing, or the prior is not positive definite.
std::optional<GaussianPose> iterated_update(const Linearises<Pose2, 3, LaserScan>& model,
                                            const LaserScan& scan, const GaussianPose& prior,
                                            int most_iterations = 20);

}  // namespace cairn
