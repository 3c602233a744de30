#include "cairn/localization/global_search.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kShare = 0.5;  // of what is told, for what a search finds
constexpr double kSame_m = 1.0;
constexpr double kSame_rad = 0.35;
// A search confirms the belief if it has seen enough of the way, and what it finds is there, all but so much.
// In a corridor a place has neighbours along the wall that no look tells from it: they are the same place.
constexpr double kSure = 0.95;
constexpr std::size_t kEnoughGlimpses = 8;
constexpr double kNeighbour_m = 2.0;
constexpr double kMostUnknown_s =
    1.0;                     // the ends of a log, and a scan before the first odometry, are shorter
constexpr int kSilent = 50;  // measurements of others, after which a stream counts as silent

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

void GlobalSearch::carry(GlobalSearchMemory& memory, const PoseControl& control) {
  memory.unknown_s += control.unknown_s;
  if (memory.unknown_s > kMostUnknown_s) memory = {};
  const Pose2 T_now_before = inverse(control.T_before_after);
  for (Glimpse& glimpse : memory.glimpses) glimpse.T_now_then = T_now_before * glimpse.T_now_then;
  for (LocatedPose& place : memory.found) place.T_map_base = place.T_map_base * control.T_before_after;
}

// Whether a measurement is of the stream that is searched with.
bool GlobalSearch::is_of(GlobalSearchMemory& memory, StreamId stream) {
  memory.of_others = stream == memory.stream ? 0 : memory.of_others + 1;
  if (memory.of_others == 0) return true;
  if (memory.of_others < kSilent) return false;
  memory.stream = stream;
  memory.glimpses.clear();
  memory.of_others = 0;
  return true;
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
                           const PoseFilter& filter) const {
  if (!memory.searching || !is_of(memory, stream)) return false;
  if (!remember(memory, z) || ++memory.new_glimpses < options_.search_every) return false;
  memory.new_glimpses = 0;
  std::vector<Pose2> asked;
  for (const Hypothesis& place : places) asked.push_back(place.T_map_base);
  for (const LocatedPose& place : memory.found) asked.push_back(place.T_map_base);
  std::vector<LocatedPose> found = model.locate(memory.glimpses, asked);
  if (found.empty()) return false;
  memory.found = std::move(found);
  if (confirms(memory, places, filter)) memory = {};
  return true;
}

bool GlobalSearch::confirms(const GlobalSearchMemory& memory, std::span<const Hypothesis> places,
                            const PoseFilter& filter) {
  if (memory.glimpses.size() < kEnoughGlimpses || places.empty() || !filter.compact()) return false;
  double there = 0.0;
  for (const LocatedPose& found : memory.found)
    if (are_near(places[0].T_map_base, found.T_map_base, kNeighbour_m, kSame_rad)) there += found.weight;
  return there >= kSure;
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
  return both;
}

void GlobalSearch::temper(const GlobalSearchMemory& memory, Judgement& judgement) {
  if (!memory.searching) return;
  judgement.probability = std::min(judgement.probability, kMostUnconfirmed);
  if (judgement.state == TrackingState::kTracking || judgement.state == TrackingState::kCrowded)
    judgement.state = TrackingState::kAmbiguous;
}

}  // namespace cairn
