#pragma once

#include "cairn/core/large_vector.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/likelihood_plane_kernels.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// End points of the beams of one scan in the robot's frame, in cells.
struct BeamsInCells {
  std::size_t count = 0;
  std::vector<float> x;  ///< `count` of them and some padding
  std::vector<float> y;
};

/// A log-likelihood per cell of a grid, as a whole number of equal steps below the best one; a border around
/// the grid stands for everything off it.
///
/// The log-likelihood of a cell is `best - step * code`: exact for the best (distance 0) and the worst (the
/// largest distance, which is also that of the border), within half a step between. Codes have 8 bits or 16.
class LikelihoodPlane {
 public:
  enum class Codes { k8Bit, k16Bit };

  /// @throws InputError for a grid that is longer than 2^20 cells or has more than 2^32
  /// @param log_likelihood of an end point by its distance to the nearest wall, metres; falling
  LikelihoodPlane(const DistanceField& field, Codes codes,
                  const std::function<double(double)>& log_likelihood);

  double best() const { return best_; }
  double step() const { return step_; }
  Codes codes() const { return wide_.empty() ? Codes::k8Bit : Codes::k16Bit; }

  /// Beams with these end points (metres, in the robot's frame). Farther than any map is as good as anywhere
  /// off it.
  BeamsInCells in_cells(std::span<const Point2> points) const;

  /// sums[i]: the codes of all beams, seen from state i (T_map_base), added up. A state that is not finite or
  /// off the map by more than 2^20 cells sees nothing but the border. Positions are held as floats, so that
  /// an end point within about 1e-7 of the map's size of a cell's edge may fall into the neighbour.
  void sum_codes(const BeamsInCells& beams, std::span<const Pose2> states,
                 std::span<std::uint32_t> sums) const;

  /// `best * beams - step * sum`: the log-likelihood of a sum of codes.
  double log_likelihood(std::size_t beams, std::uint32_t sum) const {
    return best_ * static_cast<double>(beams) - step_ * static_cast<double>(sum);
  }

  /// The log-likelihood of all end points (metres, in the robot's frame) seen from a state, interpolated
  /// bilinearly between the centres of the cells, and its derivative by x, y (1/m, map frame) and heading
  /// (1/rad). It climbs to the walls where the plane itself is flat within each cell. Beyond the border, and
  /// for a state that is not finite, it is that of the worst cell and flat.
  Eigen::Vector4d interpolate(std::span<const Point2> points, const Pose2& T_map_base) const;

 private:
  double value_at(double column, double row) const;
  Eigen::Vector3d interpolate_at(const Point2& p_cells) const;
  template <class Code>
  void fill(const DistanceField& field, const std::function<double(double)>& log_likelihood,
            LargeVector<Code>& codes);

  Pose2 T_grid_map_;
  double cells_per_m_;
  std::uint32_t columns_;  ///< with the border
  std::uint32_t rows_;
  double best_ = 0.0;
  double step_ = 0.0;
  LargeVector<std::uint8_t> narrow_;
  LargeVector<std::uint16_t> wide_;
};

}  // namespace cairn
