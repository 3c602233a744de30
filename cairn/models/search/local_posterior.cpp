#include "cairn/models/search/local_posterior.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr int kHalf = 4;  // 2 * 4 + 1 places along each axis
constexpr int kFits = 5;
constexpr double kShrink = 3.0;  // per fit: a box must not lose a mode between its places
constexpr double kSigmas = 3.0;
// A likelihood narrower than this is one of a map of finer cells than any we know.
constexpr double kNarrowest_m = 0.01;
constexpr double kNarrowest_rad = 0.002;

/// A box of poses: position along its own two axes, heading.
struct Box {
  Pose2 T_map_center;  ///< the heading tells the axes
  double theta;        ///< heading of the middle
  double half_x_m;
  double half_y_m;
  double half_rad;
};

std::vector<Pose2> lattice(const Box& box) {
  std::vector<Pose2> poses;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const Point2 p = box.T_map_center * Point2{box.half_x_m * i / kHalf, box.half_y_m * j / kHalf};
      for (int k = -kHalf; k <= kHalf; ++k) {
        poses.push_back({p.x, p.y, normalize_angle(box.theta + box.half_rad * k / kHalf)});
      }
    }
  }
  return poses;
}

LocalPosterior integrate(const BoundUpdate<Pose2>& z, const Box& box) {
  const std::vector<Pose2> poses = lattice(box);
  std::vector<double> log_likelihoods(poses.size());
  z.log_likelihood(poses, log_likelihoods);
  LocalPosterior posterior;
  posterior.largest = *std::max_element(log_likelihoods.begin(), log_likelihoods.end());
  std::vector<double> weights;
  double sum = 0.0;
  for (const double l : log_likelihoods) sum += weights.emplace_back(std::exp(l - posterior.largest));
  const PoseMoments moments = weighted_moments(poses, weights);
  posterior.mean = moments.mean;
  posterior.covariance = moments.covariance;
  const double step = 1.0 / (kHalf * kHalf * static_cast<double>(kHalf));
  posterior.log_mass = posterior.largest + std::log(sum * box.half_x_m * box.half_y_m * box.half_rad * step);
  return posterior;
}

// The box of 3 standard deviations, as the position's covariance lies, within the reach.
Box fitted(const LocalPosterior& p, const Box& before, const LocalPosteriorOptions& o) {
  const double xx = p.covariance(0, 0), yy = p.covariance(1, 1), xy = p.covariance(0, 1);
  const double middle = (xx + yy) / 2.0;
  const double radius = std::hypot((xx - yy) / 2.0, xy);
  const double axis = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const auto half = [&](double variance, double least, double most) {
    return std::clamp(kSigmas * std::sqrt(std::max(variance, 0.0)), std::min(least, most), most);
  };
  const double least_m =
      std::max(kSigmas * kNarrowest_m, std::min(before.half_x_m, before.half_y_m) / kShrink);
  const double least_rad = std::max(kSigmas * kNarrowest_rad, before.half_rad / kShrink);
  return {{p.mean.x, p.mean.y, axis},
          p.mean.theta,
          half(middle + radius, least_m, o.reach_m),
          half(middle - radius, least_m, o.reach_m),
          half(p.covariance(2, 2), least_rad, o.reach_rad)};
}

}  // namespace

LocalPosterior local_posterior(const BoundUpdate<Pose2>& z, const Pose2& around,
                               const LocalPosteriorOptions& options) {
  Box box{{around.x, around.y, 0.0}, around.theta, options.reach_m, options.reach_m, options.reach_rad};
  LocalPosterior posterior = integrate(z, box);
  for (int fit = 1; fit < kFits; ++fit) {
    box = fitted(posterior, box, options);
    posterior = integrate(z, box);
  }
  return posterior;
}

}  // namespace cairn
