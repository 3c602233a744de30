#include "cairn/localization/recovery.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace cairn {
namespace {

constexpr std::size_t kAsked = 200;         // of the particles: what the belief is worth
constexpr double kLeastProbability = 1e-3;  // the monitor is never surer than that
constexpr double kLeastSigma = 1e-4;

// L with L L^T = covariance. A mode at the edge of what was looked at may have one that is no covariance.
Eigen::Matrix3d root_of(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return kLeastSigma * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> own(covariance);
  const Eigen::Vector3d sigmas = own.eigenvalues().cwiseMax(kLeastSigma * kLeastSigma).cwiseSqrt();
  return own.eigenvectors() * sigmas.asDiagonal();
}

bool is_near(const Pose2& T, double within_m, double within_rad) {
  return std::hypot(T.x, T.y) < within_m && std::abs(normalize_angle(T.theta)) < within_rad;
}

}  // namespace

void RecoveryOptions::visit(OptionVisitor& v) {
  v.flag({"active", "look for a robot that is lost (recipes mcl, kld_mcl, cgr and ckld_mcl)"}, active);
  v.number({"doubt", "a search begins when the pose is right with less than this probability"}, doubt,
           {0.0, 1.0});
  v.number({"every_s", "time between two searches, doubled after each that finds nothing, seconds"}, every_s,
           {0.0, 1e6});
  v.number({"at_most_every_s", "up to this, seconds"}, at_most_every_s, {0.0, 1e6});
  v.integer({"scans", "of the last ones that may be joined"}, scans, {1, 100});
  v.number({"spacing_m", "joined scans are this far apart, metres"}, spacing_m, {0.0, 100.0});
  v.number({"spacing_rad", "or turned by this, radians"}, spacing_rad, {0.0, 7.0});
  v.integer({"most_poses", "distinct places that a search finds"}, most_poses, {1, 10000});
  v.number({"sigma_hit_m", "as laser.sigma_hit_m, in the search, metres"}, sigma_hit_m, {1e-3, 10.0});
  v.number({"effective_beams", "as laser.effective_beams, for the first of the joined scans"},
           effective_beams, {0.1, 100000});
  v.number({"further_beams", "likewise for each of the others"}, further_beams, {0.0, 100000});
  v.number({"millions_of_points", "a search looks up at most this many million end points"},
           millions_of_points, {0.01, 1e6});
  v.integer({"particles", "that come in"}, particles, {1, 1'000'000});
  v.number({"least_share", "candidates that deserve less of the belief do not come in"}, least_share,
           {0.0, 1.0});
}

void Recovery::carry(RecoveryMemory& memory, const Pose2& T_before_after) {
  const Pose2 T_now_before = inverse(T_before_after);
  for (Glimpse& glimpse : memory.glimpses) glimpse.T_now_then = T_now_before * glimpse.T_now_then;
}

void Recovery::observe(RecoveryMemory& memory, StreamId stream, const Event::Payload& z,
                       bool in_doubt) const {
  std::vector<Glimpse>& glimpses = memory.glimpses;
  if (!in_doubt) {
    glimpses.clear();
    memory.wait_s = 0.0;
    return;
  }
  if (glimpses.empty()) memory.stream = stream;
  if (stream != memory.stream) return;
  // The newest one is replaced as long as it is near the one before it.
  if (glimpses.size() >= 2) {
    const Pose2 between_last_two =
        inverse(glimpses[glimpses.size() - 2].T_now_then) * glimpses.back().T_now_then;
    if (is_near(between_last_two, options_.spacing_m, options_.spacing_rad)) glimpses.pop_back();
  }
  if (glimpses.size() == static_cast<std::size_t>(options_.scans)) glimpses.erase(glimpses.begin());
  glimpses.push_back({z, Pose2{}});
}

bool Recovery::due(const RecoveryMemory& memory, Time now, double probability) const {
  if (!options_.active || probability >= options_.doubt || memory.glimpses.empty()) return false;
  const double wait_s = std::max(memory.wait_s, options_.every_s);
  return !memory.searched || to_seconds(now - memory.searched_at) >= wait_s || now < memory.searched_at;
}

double Recovery::share_of(const SearchFinding& finding, double probability) const {
  if (finding.poses.empty() || finding.log_likelihood.empty()) return 0.0;
  const double right = std::clamp(probability, kLeastProbability, 1.0 - kLeastProbability);
  const double believed =
      log_sum_exp(finding.log_likelihood) - std::log(static_cast<double>(finding.log_likelihood.size()));
  const double odds = finding.log_evidence - believed + std::log((1.0 - right) / right);
  return 1.0 / (1.0 + std::exp(-odds));
}

double Recovery::recover(RecoveryMemory& memory, const StreamModel& model, Time now, double probability,
                         PoseFilter& filter) const {
  if (!due(memory, now, probability)) return 0.0;
  const auto finding = model.search(memory.glimpses, filter.sample(kAsked));
  if (!finding) return 0.0;
  memory.searched = true;
  memory.searched_at = now;
  ++memory.searches;
  const double share = share_of(*finding, probability);
  if (share < options_.least_share) {
    memory.wait_s = std::min(2.0 * std::max(memory.wait_s, options_.every_s), options_.at_most_every_s);
    return 0.0;
  }
  take_in(finding->poses, std::min(share, 1.0 - options_.least_share), memory.searches, filter);
  return share;
}

void Recovery::take_in(const std::vector<LocatedPose>& poses, double share, std::uint32_t search,
                       PoseFilter& filter) const {
  const RandomStream random(seed_, RandomPurpose::kCandidates, search);
  std::vector<Pose2> states;
  std::vector<double> weights;
  for (const LocatedPose& pose : poses) {
    const Eigen::Matrix3d root = root_of(pose.covariance);
    const auto count =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(pose.weight * options_.particles)));
    for (std::size_t i = 0; i < count; ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(states.size()));
      const Eigen::Vector3d d = root * Eigen::Vector3d(n[0], n[1], n[2]);
      const Pose2& mean = pose.T_map_base;
      states.push_back({mean.x + d.x(), mean.y + d.y(), normalize_angle(mean.theta + d.z())});
      weights.push_back(pose.weight / static_cast<double>(count));
    }
  }
  filter.take_in(states, weights, share);
}

}  // namespace cairn
