#include "cairn/models/sensor/likelihood_plane.hpp"

#include <cmath>

namespace cairn {

// Of the cell at whole numbers of plane cells; the border stands for what is beyond.
double LikelihoodPlane::value_at(double column, double row) const {
  const bool inside = column >= 0.0 && column < columns_ && row >= 0.0 && row < rows_;
  const std::size_t i =
      inside ? static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column) : 0;
  return best_ - step_ * static_cast<double>(wide_.empty() ? narrow_[i] : wide_[i]);
}

// Value and derivative by column and row, for a point in plane cells.
Eigen::Vector3d LikelihoodPlane::interpolate_at(const Point2& p) const {
  const double left = std::floor(p.x - 0.5), below = std::floor(p.y - 0.5);
  const double u = p.x - 0.5 - left, v = p.y - 0.5 - below;
  const double f00 = value_at(left, below), f10 = value_at(left + 1.0, below);
  const double f01 = value_at(left, below + 1.0), f11 = value_at(left + 1.0, below + 1.0);
  const double lower = f00 + u * (f10 - f00), upper = f01 + u * (f11 - f01);
  return {lower + v * (upper - lower), (1.0 - v) * (f10 - f00) + v * (f11 - f01), upper - lower};
}

Eigen::Vector4d LikelihoodPlane::interpolate(std::span<const Point2> points, const Pose2& T_map_base) const {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  if (!is_finite(T_map_base)) {
    sum[0] = static_cast<double>(points.size()) * value_at(0.0, 0.0);
    return sum;
  }
  const double c = std::cos(T_map_base.theta), s = std::sin(T_map_base.theta);
  const double c_grid = std::cos(T_grid_map_.theta), s_grid = std::sin(T_grid_map_.theta);
  for (const Point2& p : points) {
    const Point2 arm{c * p.x - s * p.y, s * p.x + c * p.y};
    const Point2 end = T_grid_map_ * Point2{T_map_base.x + arm.x, T_map_base.y + arm.y};
    const Eigen::Vector3d f = interpolate_at({end.x * cells_per_m_ + 1.0, end.y * cells_per_m_ + 1.0});
    // From the axes and cells of the grid to the axes and metres of the map.
    const double dx = cells_per_m_ * (c_grid * f[1] + s_grid * f[2]);
    const double dy = cells_per_m_ * (c_grid * f[2] - s_grid * f[1]);
    sum += Eigen::Vector4d(f[0], dx, dy, arm.x * dy - arm.y * dx);
  }
  return sum;
}

}  // namespace cairn
