#include "cairn/localization/rivals.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

void Rivals::carry(std::vector<Rival>& rivals, const Pose2& T_before_after, double since_s) {
  for (Rival& rival : rivals) {
    rival.T_map_base = rival.T_map_base * T_before_after;
    rival.age_s += since_s;
  }
}

bool Rivals::same(const Pose2& a, const Pose2& b) const {
  return distance(a, b) < rules_.same_m && std::abs(normalize_angle(a.theta - b.theta)) < rules_.same_rad;
}

double Rivals::evidence(double fit) const { return std::max(rules_.beams * fit, -rules_.largest); }

void Rivals::weigh(std::vector<Rival>& rivals, const StreamModel& model, const Event::Payload& z,
                   const Pose2& believed, double news) const {
  if (rivals.empty()) return;
  std::vector<Pose2> places{believed};
  for (const Rival& rival : rivals) places.push_back(rival.T_map_base);
  std::vector<double> fits(places.size());
  if (!model.follow(z, places, fits)) return;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    rivals[i].T_map_base = places[i + 1];
    ++rivals[i].scans;
    rivals[i].log_odds += news * (evidence(fits[i + 1]) - evidence(fits[0]));
  }
  merge(rivals, believed);
  prune(rivals, believed);
}

// Two that have become one place: it has the odds of both.
void Rivals::merge(std::vector<Rival>& rivals, const Pose2& believed) const {
  std::vector<double> log_odds{0.0};
  for (const Rival& rival : rivals) {
    if (same(rival.T_map_base, believed)) log_odds.push_back(rival.log_odds);
  }
  if (log_odds.size() == 1) return;
  std::erase_if(rivals, [&](const Rival& rival) { return same(rival.T_map_base, believed); });
  const double gained = log_sum_exp(log_odds);
  for (Rival& rival : rivals) rival.log_odds -= gained;
}

// The strongest first; of those at one place it is the one that stays.
void Rivals::prune(std::vector<Rival>& rivals, const Pose2& believed) const {
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.log_odds > b.log_odds; });
  std::size_t kept = 0;
  for (const Rival& rival : rivals) {
    const auto known = rivals.begin() + static_cast<std::ptrdiff_t>(kept);
    const bool doubled =
        same(rival.T_map_base, believed) || std::any_of(rivals.begin(), known, [&](const Rival& other) {
          return same(rival.T_map_base, other.T_map_base);
        });
    if (doubled || rival.log_odds < rules_.least || kept == rules_.most) continue;
    rivals[kept++] = rival;
  }
  rivals.resize(kept);
}

void Rivals::add(std::vector<Rival>& rivals, const Rival& found, const Pose2& believed) const {
  const bool known = std::any_of(rivals.begin(), rivals.end(), [&](const Rival& other) {
    return same(found.T_map_base, other.T_map_base);
  });
  if (!known) rivals.push_back(found);
  prune(rivals, believed);
}

Rival* Rivals::strongest(std::vector<Rival>& rivals, int scans) {
  Rival* best = nullptr;
  for (Rival& rival : rivals) {
    if (rival.scans >= scans && (best == nullptr || rival.log_odds > best->log_odds)) best = &rival;
  }
  return best;
}

Rival Rivals::take_over(std::vector<Rival>& rivals, Rival& winner, const Pose2& believed) const {
  const Rival won = winner;
  winner.T_map_base = believed;
  winner.log_odds = 0.0;
  for (Rival& rival : rivals) rival.log_odds -= won.log_odds;
  prune(rivals, won.T_map_base);
  return won;
}

double Rivals::share(const std::vector<Rival>& rivals, double log_odds) {
  double others = std::exp(-log_odds);
  for (const Rival& rival : rivals) others += std::exp(rival.log_odds - log_odds);
  return 1.0 / others;
}

}  // namespace cairn
