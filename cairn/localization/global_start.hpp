#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/executor.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/search/one_shot.hpp"

#include <vector>

namespace cairn {

/// Samples of p(x | z) for the first measurement z of a robot that may be anywhere: poses uniform over the
/// free cells and all headings, many more than a filter could carry along, weighed once by the measurement.
///
/// Starting a filter from a few thousand uniform particles leaves none near the true pose in most runs; one
/// pass over some hundred candidates per square metre costs a few milliseconds and is done once.
class GlobalStart {
 public:
  /// @param per_square_metre candidates per square metre of free space, at most `kMostCandidates` in all
  /// @throws ConfigurationError if the map has no free cell
  GlobalStart(const OccupancyGrid& map, double per_square_metre, std::uint64_t seed);

  /// Weighs all candidates; the measurement is flattened where it would leave less than `kLeastEssShare` of
  /// them (tempering_exponent).
  void weigh(const BoundUpdate<Pose2>& z, const Executor& executor);

  /// Places found otherwise (one_shot.hpp): a share of the samples comes from them, by their weights and
  /// normally distributed as their covariances say. None: no sample.
  void add_modes(std::vector<LocatedPose> modes);

  /// A candidate, or a pose around a mode, drawn by its weight; the same for the same `item`.
  /// @pre weigh has been called
  Pose2 sample(const RandomStream& random, std::uint32_t item) const;

  static constexpr std::size_t kMostCandidates = 5'000'000;
  static constexpr double kLeastEssShare = 0.01;
  static constexpr double kModesShare = 0.5;

 private:
  Pose2 sample_mode(double u, const RandomStream& random, std::uint32_t item) const;

  std::vector<Pose2> candidates_;
  std::vector<double> cumulative_;
  std::vector<LocatedPose> modes_;
  std::vector<Eigen::Matrix3d> spreads_;  ///< L L^T = covariance of a mode
  double modes_share_ = 0.0;
};

}  // namespace cairn
