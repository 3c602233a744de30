#include "cairn/maps/ray_marching.hpp"

#include "cairn/core/errors.hpp"

namespace cairn {

struct RayMarcher::Field {
  OccupancyGrid grid;
  RayStop stop;
};

RayMarcher::RayMarcher(const OccupancyGrid& grid, double max_range_m, RayStop stop)
    : field_(std::make_unique<const Field>(Field{grid, stop})), max_range_m_(max_range_m) {
  if (!(max_range_m > 0.0))
    throw ConfigurationError("max_range_m", "is not positive", "give the scanner's range");
}

RayMarcher::~RayMarcher() = default;
RayMarcher::RayMarcher(RayMarcher&&) noexcept = default;
RayMarcher& RayMarcher::operator=(RayMarcher&&) noexcept = default;

void RayMarcher::cast(std::span<const Pose2> T_map_sensor, std::span<const double> bearings_rad,
                      std::span<float> ranges_m) const {
  CAIRN_ASSERT(ranges_m.size() == T_map_sensor.size() * bearings_rad.size());
  std::size_t i = 0;
  for (const Pose2& pose : T_map_sensor) {
    for (const double bearing : bearings_rad) {
      const Pose2 ray{pose.x, pose.y, pose.theta + bearing};
      ranges_m[i++] = static_cast<float>(cast_ray(field_->grid, ray, max_range_m_, field_->stop));
    }
  }
}

}  // namespace cairn
