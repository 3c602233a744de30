#include "cairn/localization/global_search.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cairn {
namespace {

constexpr double kShare = 0.5;  // of the belief, for what a search finds
constexpr int kParticles = 1000;
constexpr int kLeastParticles = 20;  // per place
// A search confirms the belief if it knows no other place, has seen enough of the way, and finds the same.
constexpr double kSure = 0.99;
constexpr std::size_t kEnoughGlimpses = 8;
constexpr double kSame_m = 1.0;
constexpr double kSame_rad = 0.35;

bool are_near(const Pose2& a, const Pose2& b, double within_m, double within_rad) {
  return distance(a, b) < within_m && std::abs(normalize_angle(a.theta - b.theta)) < within_rad;
}

}  // namespace

std::vector<LocatedPose> GlobalSearch::begin(GlobalSearchMemory& memory, StreamId stream,
                                             const StreamModel& model, const Event::Payload& z) const {
  memory = {};
  memory.stream = stream;
  memory.glimpses.push_back({z, Pose2{}});
  memory.found = model.locate(memory.glimpses, {});
  memory.searching = !memory.found.empty();
  return memory.found;
}

// What was seen before a time without odometry cannot be joined with what comes after it.
void GlobalSearch::carry(GlobalSearchMemory& memory, const PoseControl& control) {
  if (control.unknown_s > 0.0) memory.glimpses.clear();
  const Pose2 T_now_before = inverse(control.T_before_after);
  for (Glimpse& glimpse : memory.glimpses) glimpse.T_now_then = T_now_before * glimpse.T_now_then;
  for (LocatedPose& place : memory.found) place.T_map_base = place.T_map_base * control.T_before_after;
}

// The newest one is replaced as long as it is near the one before it. True if one more has come to stay.
bool GlobalSearch::remember(GlobalSearchMemory& memory, const Event::Payload& z) const {
  std::vector<Glimpse>& glimpses = memory.glimpses;
  const auto is_near = [&](const Glimpse& a, const Glimpse& b) {
    return are_near(a.T_now_then, b.T_now_then, options_.look_spacing_m, options_.look_spacing_rad);
  };
  const bool replaces = glimpses.size() >= 2 && is_near(glimpses[glimpses.size() - 2], glimpses.back());
  if (replaces) glimpses.pop_back();
  if (glimpses.size() >= static_cast<std::size_t>(options_.search_looks)) glimpses.erase(glimpses.begin());
  glimpses.push_back({z, Pose2{}});
  return !replaces;
}

bool GlobalSearch::observe(GlobalSearchMemory& memory, StreamId stream, const StreamModel& model,
                           const Event::Payload& z, std::span<const Hypothesis> places,
                           PoseFilter& filter) const {
  if (!memory.searching || stream != memory.stream) return false;
  if (!remember(memory, z) || ++memory.new_glimpses < options_.search_every) return false;
  memory.new_glimpses = 0;
  ++memory.searches;
  std::vector<Pose2> asked;
  for (const Hypothesis& place : places) asked.push_back(place.T_map_base);
  for (const LocatedPose& place : memory.found) asked.push_back(place.T_map_base);
  std::vector<LocatedPose> found = model.locate(memory.glimpses, asked);
  if (found.empty()) return false;
  memory.found = std::move(found);
  if (confirms(memory, places, filter)) {
    memory = {};
    return false;
  }
  take_in(memory.found, memory.searches, filter);
  return true;
}

bool GlobalSearch::confirms(const GlobalSearchMemory& memory, std::span<const Hypothesis> places,
                            const PoseFilter& filter) {
  return memory.glimpses.size() >= kEnoughGlimpses && memory.found[0].weight >= kSure && filter.compact() &&
         !places.empty() && are_near(places[0].T_map_base, memory.found[0].T_map_base, kSame_m, kSame_rad);
}

void GlobalSearch::take_in(std::span<const LocatedPose> found, std::uint32_t search,
                           PoseFilter& filter) const {
  const RandomStream random(seed_, RandomPurpose::kCandidates,
                            std::uint64_t{search} + (std::uint64_t{1} << 32U));
  std::vector<Pose2> states;
  std::vector<double> weights;
  for (const LocatedPose& place : found) {
    const int count = std::max(kLeastParticles, static_cast<int>(std::lround(place.weight * kParticles)));
    const Eigen::LDLT<Eigen::Matrix3d> ldlt(place.covariance);
    const Eigen::Vector3d sigmas = ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
    for (int i = 0; i < count; ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(states.size()));
      const Eigen::Vector3d d =
          ldlt.transpositionsP().transpose() *
          (ldlt.matrixL() * sigmas.cwiseProduct(Eigen::Vector3d(n[0], n[1], n[2]))).eval();
      const Pose2& mean = place.T_map_base;
      states.push_back({mean.x + d.x(), mean.y + d.y(), normalize_angle(mean.theta + d.z())});
      weights.push_back(place.weight / count);
    }
  }
  filter.take_in(states, weights, kShare);
}

std::vector<PoseHypothesis> GlobalSearch::with_found(const GlobalSearchMemory& memory,
                                                     std::span<const PoseHypothesis> places) {
  std::vector<PoseHypothesis> both(places.begin(), places.end());
  if (!memory.searching) return both;
  for (PoseHypothesis& place : both) place.weight *= 1.0 - kShare;
  for (const LocatedPose& found : memory.found) {
    const double weight = kShare * found.weight;
    const auto known = std::find_if(both.begin(), both.end(), [&](const PoseHypothesis& place) {
      return are_near(place.mean, found.T_map_base, kSame_m, kSame_rad);
    });
    known == both.end() ? both.push_back({weight, found.T_map_base, found.covariance, 0})
                        : void(known->weight += weight);
  }
  std::stable_sort(both.begin(), both.end(),
                   [](const PoseHypothesis& a, const PoseHypothesis& b) { return a.weight > b.weight; });
  return both;
}

void GlobalSearch::temper(const GlobalSearchMemory& memory, Judgement& judgement) {
  if (!memory.searching) return;
  judgement.probability = std::min(judgement.probability, kMostUnconfirmed);
  if (judgement.state == TrackingState::kTracking || judgement.state == TrackingState::kCrowded)
    judgement.state = TrackingState::kAmbiguous;
}

}  // namespace cairn
