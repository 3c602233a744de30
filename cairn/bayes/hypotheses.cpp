#include "cairn/bayes/hypotheses.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace cairn {
namespace {

using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
// Cells far below the limit need no place in the fusion, whose cost grows with the square of their number.
constexpr double kCellShare = 0.01;

/// Weight and weighted sums of a group of poses: what its mean needs.
struct Group {
  double weight = 0.0;
  double x = 0.0, y = 0.0;
  double cosine = 0.0, sine = 0.0;

  void add(const Pose2& p, double w) {
    weight += w;
    x += w * p.x, y += w * p.y;
    cosine += w * std::cos(p.theta), sine += w * std::sin(p.theta);
  }
  Pose2 mean() const { return {x / weight, y / weight, std::atan2(sine, cosine)}; }
};

Cell cell_of(const Pose2& pose, const HypothesisOptions& o) {
  const double headings = std::max(1.0, std::round(kTwoPi / o.cell_rad));
  const double turn = std::floor((normalize_angle(pose.theta) + kPi) / kTwoPi * headings);
  return {static_cast<std::int64_t>(std::floor(pose.x / o.cell_m)),
          static_cast<std::int64_t>(std::floor(pose.y / o.cell_m)),
          static_cast<std::int64_t>(std::min(turn, headings - 1.0))};
}

bool close(const Pose2& a, const Pose2& b, const HypothesisOptions& o) {
  return distance(a, b) < o.fuse_m && std::abs(normalize_angle(a.theta - b.theta)) < o.fuse_rad;
}

/// Fuses whatever is close, also over several steps in between. Returns the group of each cell.
std::vector<int> fuse(const std::vector<Group>& cells, const HypothesisOptions& o) {
  std::vector<Pose2> means;
  means.reserve(cells.size());
  for (const Group& cell : cells) means.push_back(cell.mean());
  std::vector<int> group(cells.size(), -1);
  int groups = 0;
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (group[first] >= 0) continue;
    std::vector<std::size_t> open = {first};
    group[first] = groups;
    while (!open.empty()) {
      const Pose2 mean = means[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (group[i] >= 0 || !close(mean, means[i], o)) continue;
        group[i] = groups;
        open.push_back(i);
      }
    }
    ++groups;
  }
  return group;
}

// rank[g]: place of group g among the significant ones, heaviest 0; -1 if it is not significant.
std::vector<int> rank_by_weight(const std::vector<double>& weights, double significance) {
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
  std::vector<int> rank(weights.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (weights[order[i]] >= significance * weights[order[0]]) rank[order[i]] = static_cast<int>(i);
  }
  return rank;
}

PoseHypothesis summarize(std::span<const Pose2> poses, std::span<const double> weights,
                         const std::vector<int>& label, int wanted) {
  PoseHypothesis hypothesis;
  std::vector<Pose2> own;
  std::vector<double> own_weights;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (label[i] != wanted) continue;
    own.push_back(poses[i]);
    own_weights.push_back(weights[i]);
    hypothesis.weight += weights[i];
  }
  hypothesis.particles = own.size();
  const PoseMoments moments = weighted_moments(own, own_weights);
  hypothesis.mean = moments.mean;
  hypothesis.covariance = moments.covariance;
  return hypothesis;
}

}  // namespace

void HypothesisOptions::visit(OptionVisitor& v) {
  v.number({"cell_m", "sides of the grid that gathers particles to groups, metres"}, cell_m, {0.01, 1000.0});
  v.number({"cell_rad", "likewise of the heading, radians"}, cell_rad, {0.01, 7.0});
  v.number({"fuse_m", "groups nearer than this and turned by less than fuse_rad are one, metres"}, fuse_m,
           {0.0, 1000.0});
  v.number({"fuse_rad", "likewise, radians"}, fuse_rad, {0.0, 7.0});
  v.number({"significance", "groups below this share of the heaviest one are given up"}, significance,
           {0.0, 1.0});
}

PoseHypotheses find_hypotheses(std::span<const Pose2> poses, std::span<const double> weights,
                               const HypothesisOptions& options) {
  CAIRN_ASSERT(poses.size() == weights.size() && !poses.empty());
  std::map<Cell, std::pair<Group, int>> cells;  // ordered, so that nothing depends on hashing
  std::vector<Cell> cell_of_pose;
  double heaviest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    cell_of_pose.push_back(cell_of(poses[i], options));
    Group& cell = cells.try_emplace(cell_of_pose.back(), Group{}, -1).first->second.first;
    cell.add(poses[i], weights[i]);
    heaviest = std::max(heaviest, cell.weight);
  }
  std::vector<Group> heavy;
  for (auto& [key, cell] : cells) {
    if (cell.first.weight <= 0.0 || cell.first.weight < kCellShare * options.significance * heaviest)
      continue;
    cell.second = static_cast<int>(heavy.size());
    heavy.push_back(cell.first);
  }
  const std::vector<int> group = fuse(heavy, options);
  std::vector<double> group_weight(heavy.size(), 0.0);
  for (std::size_t i = 0; i < heavy.size(); ++i)
    group_weight[static_cast<std::size_t>(group[i])] += heavy[i].weight;
  group_weight.resize(static_cast<std::size_t>(*std::max_element(group.begin(), group.end())) + 1);
  const std::vector<int> rank = rank_by_weight(group_weight, options.significance);

  PoseHypotheses result;
  for (const Cell& key : cell_of_pose) {
    const int cell = cells.at(key).second;
    result.label.push_back(cell < 0 ? -1
                                    : rank[static_cast<std::size_t>(group[static_cast<std::size_t>(cell)])]);
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto significant = std::count_if(rank.begin(), rank.end(), [](int r) { return r >= 0; });
  for (int h = 0; h < significant; ++h) {
    result.found.push_back(summarize(poses, weights, result.label, h));
    result.found.back().weight /= total;
  }
  return result;
}

}  // namespace cairn
