#include "cairn/models/search/one_shot.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

BoundUpdate<Pose2> likelihood_of(const PoseSearch& search, std::span<const Point2> points, double scale) {
  return {{}, [&search, points, scale](std::span<const Pose2> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i)
              out[i] = scale * search.log_likelihood(points, states[i]);
          }};
}

// Two lattice poses may climb to one mode: the second is left out.
bool is_known(const std::vector<LocatedPose>& poses, const Pose2& mean, const OneShotOptions& o) {
  return std::any_of(poses.begin(), poses.end(), [&](const LocatedPose& p) {
    return distance(p.T_map_base, mean) < 0.5 * o.separation_m &&
           std::abs(normalize_angle(p.T_map_base.theta - mean.theta)) < 0.5 * o.separation_rad;
  });
}

void set_weights(std::vector<LocatedPose>& poses, std::vector<double> log_masses) {
  if (poses.empty()) return;
  normalize_log_weights(log_masses);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].weight = std::exp(log_masses[i]);
  std::stable_sort(poses.begin(), poses.end(),
                   [](const LocatedPose& a, const LocatedPose& b) { return a.weight > b.weight; });
}

}  // namespace

void OneShotOptions::visit(OptionVisitor& v) {
  v.integer({"most_poses", "distinct poses to find"}, most_poses, {1, 10000});
  v.number({"least_weight", "poses below this share of the best one's likelihood are left out"}, least_weight,
           {1e-300, 1.0});
  v.number({"effective_beams", "the observation counts as this many independent beams"}, effective_beams,
           {0.1, 100000});
  v.number({"separation_m", "poses nearer than this and turned by less than separation_rad are one, metres"},
           separation_m, {0.01, 100.0});
  v.number({"separation_rad", "likewise, radians"}, separation_rad, {0.01, 7.0});
  v.number({"millions_of_points", "budget: the search looks up at most this many million end points"},
           millions_of_points, {0.01, 1e6});
}

OneShotResult locate(const PoseSearch& search, std::span<const Point2> points,
                     const OneShotOptions& options) {
  const double scale =
      std::min(1.0, options.effective_beams / std::max(1.0, static_cast<double>(points.size())));
  OneShotResult result;
  result.search = search.find(points, {.most_poses = options.most_poses,
                                       .separation_m = options.separation_m,
                                       .separation_rad = options.separation_rad,
                                       .margin = -std::log(options.least_weight) / scale,
                                       .budget = static_cast<std::int64_t>(options.millions_of_points * 1e6),
                                       .region = options.region});
  const BoundUpdate<Pose2> z = likelihood_of(search, points, scale);
  std::vector<double> log_masses;
  for (const FoundPose& found : result.search.poses) {
    const LocalPosterior mode =
        local_posterior(z, found.T_map_base, {0.5 * options.separation_m, 0.5 * options.separation_rad});
    if (is_known(result.poses, mode.mean, options)) continue;
    result.poses.push_back({mode.mean, mode.covariance, 0.0, mode.largest});
    log_masses.push_back(mode.log_mass);
  }
  set_weights(result.poses, std::move(log_masses));
  return result;
}

}  // namespace cairn
