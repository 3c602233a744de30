#pragma once

#include "cairn/maps/grid_ray_caster.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <memory>
#include <span>
#include <vector>

namespace cairn {

/// Directions of rays in the sensor's frame, prepared for many casts.
class RayBearings {
 public:
  explicit RayBearings(std::span<const double> bearings_rad);
  std::size_t size() const { return radians_.size(); }
  std::span<const double> radians() const { return radians_; }
  float cosine(std::size_t k) const { return cosine_[k]; }
  float sine(std::size_t k) const { return sine_[k]; }

 private:
  std::vector<double> radians_;
  std::vector<float> cosine_, sine_;
};

/// Casts many rays in one occupancy grid: the same bearings from many poses, as a beam model needs them.
///
/// Marches with steps as long as the distance to the next wall allows ("sphere tracing": Hart 1996), many
/// rays at once on all lanes of the processor; beside walls from cell to cell. A corner that a ray crosses on
/// less than a thousandth of a cell may be missed; else the range is exact in single precision. A ray that
/// begins within an obstacle ends at the next one: a robot that stands where the map has furniture that is
/// gone, or a particle a cell beside it, sees the room and not the inside of the obstacle. Every path of
/// simd.hpp gives the same bits. Memory: 1 byte a cell.
class RayMarcher {
 public:
  /// @param max_range_m what a ray returns that meets nothing before
  /// @throws ConfigurationError if `max_range_m` is not positive
  RayMarcher(const OccupancyGrid& grid, double max_range_m, RayStop stop = RayStop::kOccupied);
  ~RayMarcher();
  RayMarcher(RayMarcher&&) noexcept;
  RayMarcher& operator=(RayMarcher&&) noexcept;

  double max_range_m() const { return max_range_m_; }
  double cell_m() const;  ///< width of a cell

  /// Ranges (m) as cast_ray gives them, but for poses within an obstacle, for every pose and every bearing.
  /// @param T_map_sensor the poses; one that is not finite gets `max_range_m` for every bearing
  /// @param bearings_rad directions of the rays in the sensor's frame
  /// @param ranges_m ranges of pose i are [i * bearings, (i + 1) * bearings)
  /// May be called from several threads at once; the ranges of a pose do not depend on the other poses.
  void cast(std::span<const Pose2> T_map_sensor, std::span<const double> bearings_rad,
            std::span<float> ranges_m) const;

  /// The same ranges bearing by bearing: those of bearing k are [k * poses, (k + 1) * poses).
  void cast_by_bearing(std::span<const Pose2> T_map_sensor, const RayBearings& bearings,
                       std::span<float> ranges_m) const;

 private:
  struct Field;
  struct Place;  // of a range among the results
  void cast_blocks(std::span<const Pose2> T_map_sensor, const RayBearings& bearings, float* ranges_m,
                   const Place& place) const;
  void cast_block(std::span<const Pose2> T_map_sensor, const RayBearings& bearings, float* ranges_m,
                  const Place& place) const;
  void cast_exactly(const Pose2& pose, const RayBearings& bearings, float* ranges_m,
                    std::size_t per_bearing) const;

  std::unique_ptr<const Field> field_;
  double max_range_m_;
};

}  // namespace cairn
