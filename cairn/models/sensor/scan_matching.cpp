#include "cairn/models/sensor/scan_matching.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

namespace cairn {
namespace {

constexpr double kRests_m = 1e-4, kRests_rad = 1e-5;

// Bilinear between the centres of the cells. Beyond the outermost centres: the value at the nearest point
// between them, and the way to there. That is exact where the border is a wall, and never too small.
std::optional<WallOffset> interpolated(const DistanceField& field, const Point2& p_map) {
  const GridGeometry& grid = field.geometry();
  if (!std::isfinite(p_map.x) || !std::isfinite(p_map.y)) return std::nullopt;
  const Point2 p = grid.to_cells(p_map);
  const Point2 inside{std::clamp(p.x, 0.5, grid.width - 0.5), std::clamp(p.y, 0.5, grid.height - 0.5)};
  const int left = std::clamp(static_cast<int>(inside.x - 0.5), 0, std::max(0, grid.width - 2));
  const int below = std::clamp(static_cast<int>(inside.y - 0.5), 0, std::max(0, grid.height - 2));
  const int right = std::min(left + 1, grid.width - 1), above = std::min(below + 1, grid.height - 1);
  const double u = inside.x - 0.5 - left, v = inside.y - 0.5 - below;
  const double d00 = field.distance_m(grid.index(left, below));
  const double d10 = field.distance_m(grid.index(right, below));
  const double d01 = field.distance_m(grid.index(left, above));
  const double d11 = field.distance_m(grid.index(right, above));
  const double lower = d00 + u * (d10 - d00), upper = d01 + u * (d11 - d01);
  const Point2 outside{(p.x - inside.x) * grid.resolution_m, (p.y - inside.y) * grid.resolution_m};
  const double way = std::hypot(outside.x, outside.y);
  Point2 slope{((1.0 - v) * (d10 - d00) + v * (d11 - d01)) / grid.resolution_m,
               (upper - lower) / grid.resolution_m};
  if (outside.x != 0.0) slope.x = outside.x / way;
  if (outside.y != 0.0) slope.y = outside.y / way;
  const double c = std::cos(grid.T_map_grid.theta), s = std::sin(grid.T_map_grid.theta);
  return WallOffset{lower + v * (upper - lower) + way,
                    {c * slope.x - s * slope.y, s * slope.x + c * slope.y}};
}

struct Row {
  double distance_m;
  Eigen::RowVector3d slope;
};

Eigen::Vector3d difference(const Pose2& to, const Pose2& from) {
  return {to.x - from.x, to.y - from.y, normalize_angle(to.theta - from.theta)};
}

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& by) {
  return {pose.x + by.x(), pose.y + by.y(), normalize_angle(pose.theta + by.z())};
}

}  // namespace

DistanceToWall distance_to_cells(std::shared_ptr<const DistanceField> field) {
  return [field = std::move(field)](const Point2& p_map) { return interpolated(*field, p_map); };
}

DistanceToWall distance_to_walls(std::shared_ptr<const WallDistance> walls) {
  return [walls = std::move(walls)](const Point2& p) -> std::optional<WallOffset> {
    const auto foot = walls->nearest(p);
    if (!foot) return std::nullopt;
    const double dx = p.x - foot->x, dy = p.y - foot->y, distance = std::hypot(dx, dy);
    if (!(distance > 0.0)) return WallOffset{0.0, {}};  // on the wall: no side to prefer
    return WallOffset{distance, {dx / distance, dy / distance}};
  };
}

ScanMatching::ScanMatching(DistanceToWall distance, const Pose2& T_base_sensor, const BeamLimits& limits,
                           const ScanMatchingOptions& options)
    : distance_(std::move(distance)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

Linearised<3> ScanMatching::linearise(const LaserScan& scan, const Pose2& T_map_base) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const double c = std::cos(T_map_base.theta), s = std::sin(T_map_base.theta);
  std::vector<Row> rows;
  for (const Point2& p : points) {
    const Point2 arm{c * p.x - s * p.y, s * p.x + c * p.y};
    const auto wall = distance_({T_map_base.x + arm.x, T_map_base.y + arm.y});
    if (!wall || wall->distance_m >= options_.gate_m) continue;
    rows.push_back(
        {wall->distance_m, {wall->slope.x, wall->slope.y, arm.x * wall->slope.y - arm.y * wall->slope.x}});
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  const double share =
      std::min(1.0, options_.effective_beams / std::max(1.0, static_cast<double>(points.size())));
  Linearised<3> out{
      Eigen::VectorXd::Zero(count), Eigen::VectorXd(count), {}, Eigen::MatrixXd::Zero(count, count)};
  out.H.resize(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Row& row = rows[static_cast<std::size_t>(k)];
    const double off = row.distance_m / options_.outlier_m;
    out.z_hat[k] = row.distance_m;
    out.H.row(k) = row.slope;
    out.R(k, k) = options_.sigma_m * options_.sigma_m * (1.0 + off * off) / share;
  }
  return out;
}

std::optional<GaussianPose> iterated_update(const Linearises<Pose2, 3, LaserScan>& model,
                                            const LaserScan& scan, const GaussianPose& prior,
                                            int most_iterations) {
  const Eigen::LLT<Eigen::Matrix3d> prior_cholesky(prior.covariance);
  if (prior_cholesky.info() != Eigen::Success) return std::nullopt;
  const Eigen::Matrix3d prior_information = prior_cholesky.solve(Eigen::Matrix3d::Identity());
  GaussianPose belief = prior;
  for (int i = 0; i < most_iterations; ++i) {
    const Linearised<3> z = model.linearise(scan, belief.mean);
    if (z.size() == 0) return std::nullopt;
    const Eigen::LLT<Eigen::MatrixXd> noise(z.R);
    const Eigen::Matrix3d information = prior_information + z.H.transpose() * noise.solve(z.H);
    const Eigen::Vector3d towards =
        z.H.transpose() * noise.solve(z.residual()) + prior_information * difference(prior.mean, belief.mean);
    const Eigen::LLT<Eigen::Matrix3d> cholesky(information);
    if (cholesky.info() != Eigen::Success) return std::nullopt;
    const Eigen::Vector3d step = cholesky.solve(towards);
    belief = {moved(belief.mean, step), cholesky.solve(Eigen::Matrix3d::Identity())};
    if (step.head<2>().norm() < kRests_m && std::abs(step.z()) < kRests_rad) break;
  }
  return belief;
}

}  // namespace cairn
