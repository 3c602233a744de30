#include "cairn/localization/global_start.hpp"

#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/bayes/tempering.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cairn {
namespace {

constexpr std::size_t kChunk = 1024;

std::vector<std::size_t> free_cells(const OccupancyGrid& map) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < map.geometry().size(); ++i) {
    if (map.state(i) == CellState::kFree) cells.push_back(i);
  }
  return cells;
}

// Uniform over one of the cells, chosen at random, and all headings.
Pose2 sample_free_pose(const GridGeometry& grid, const std::vector<std::size_t>& cells,
                       const RandomStream& random, std::uint32_t item) {
  const auto u = random.uniform4(item);
  const std::size_t cell = cells[static_cast<std::size_t>(u[0] * static_cast<double>(cells.size()))];
  const auto width = static_cast<std::size_t>(grid.width);
  const std::size_t row = cell / width;
  const std::size_t column = cell % width;
  const Point2 p = grid.T_map_grid * Point2{(static_cast<double>(column) + u[1]) * grid.resolution_m,
                                            (static_cast<double>(row) + u[2]) * grid.resolution_m};
  return {p.x, p.y, normalize_angle(kTwoPi * u[3] - kPi)};
}

}  // namespace

GlobalStart::GlobalStart(const OccupancyGrid& map, double per_square_metre, std::uint64_t seed) {
  const std::vector<std::size_t> cells = free_cells(map);
  if (cells.empty())
    throw ConfigurationError("map", "has no free cell to start from", "check its thresholds");
  const double area_m2 =
      static_cast<double>(cells.size()) * map.geometry().resolution_m * map.geometry().resolution_m;
  const double wanted = std::clamp(area_m2 * per_square_metre, 1.0, static_cast<double>(kMostCandidates));
  const RandomStream random(seed, RandomPurpose::kCandidates, 0);
  candidates_.reserve(static_cast<std::size_t>(wanted));
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(wanted); ++i) {
    candidates_.push_back(sample_free_pose(map.geometry(), cells, random, i));
  }
}

void GlobalStart::weigh(const BoundUpdate<Pose2>& z, const Executor& executor) {
  std::vector<double> log_likelihoods(candidates_.size());
  executor.for_each_chunk(candidates_.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    z.log_likelihood(std::span<const Pose2>(candidates_).subspan(begin, end - begin),
                     std::span(log_likelihoods).subspan(begin, end - begin));
  });
  const std::vector<double> priors(candidates_.size(), 0.0);
  const double least_ess = kLeastEssShare * static_cast<double>(candidates_.size());
  const double exponent = tempering_exponent(priors, log_likelihoods, least_ess);
  for (double& value : log_likelihoods) value *= exponent;
  normalize_log_weights(log_likelihoods);
  cumulative_ = cumulative_weights(log_likelihoods);
}

void GlobalStart::add_modes(std::vector<LocatedPose> modes) {
  modes_ = std::move(modes);
  modes_share_ = modes_.empty() ? 0.0 : kModesShare;
  spreads_.clear();
  for (const LocatedPose& mode : modes_) {
    const Eigen::LDLT<Eigen::Matrix3d> ldlt(mode.covariance);
    const Eigen::Vector3d root = ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
    const Eigen::Matrix3d lower = ldlt.matrixL();
    spreads_.emplace_back(ldlt.transpositionsP().transpose() * (lower * root.asDiagonal()).eval());
  }
}

Pose2 GlobalStart::sample_mode(double u, const RandomStream& random, std::uint32_t item) const {
  std::size_t chosen = 0;
  for (; chosen + 1 < modes_.size() && u >= modes_[chosen].weight; ++chosen) u -= modes_[chosen].weight;
  const auto n = random.normal4(item, 1);
  const Eigen::Vector3d d = spreads_[chosen] * Eigen::Vector3d(n[0], n[1], n[2]);
  const Pose2& mean = modes_[chosen].T_map_base;
  return {mean.x + d.x(), mean.y + d.y(), normalize_angle(mean.theta + d.z())};
}

Pose2 GlobalStart::sample(const RandomStream& random, std::uint32_t item) const {
  const auto u = random.uniform4(item);
  if (u[1] < modes_share_) return sample_mode(u[0], random, item);
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u[0]);
  const auto last = static_cast<std::ptrdiff_t>(candidates_.size()) - 1;
  return candidates_[static_cast<std::size_t>(std::min(found - cumulative_.begin(), last))];
}

}  // namespace cairn
