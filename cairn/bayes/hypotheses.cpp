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

/// Weight and weighted sums of a group of poses: what its mean and its spread need.
struct Group {
  double weight = 0.0;
  double x = 0.0, y = 0.0;
  double xx = 0.0, yy = 0.0;
  double cosine = 0.0, sine = 0.0;

  void add(const Pose2& p, double w) {
    weight += w;
    x += w * p.x, y += w * p.y;
    xx += w * p.x * p.x, yy += w * p.y * p.y;
    cosine += w * std::cos(p.theta), sine += w * std::sin(p.theta);
  }
  Pose2 mean() const { return {x / weight, y / weight, std::atan2(sine, cosine)}; }
  /// Standard deviations.
  Pose2 spread() const {
    const double length = std::clamp(std::hypot(cosine, sine) / weight, 1e-300, 1.0);
    return {root_of_variance(xx, x), root_of_variance(yy, y), std::sqrt(-2.0 * std::log(length))};
  }

 private:
  double root_of_variance(double squares, double sum) const {
    return std::sqrt(std::max(0.0, squares / weight - (sum / weight) * (sum / weight)));
  }
};

/// A group as others see it.
struct Piece {
  double weight;
  Pose2 mean, spread;
};

Cell cell_of(const Pose2& pose, const HypothesisOptions& o) {
  const double headings = std::max(1.0, std::round(kTwoPi / o.cell_rad));
  const double turn = std::floor((normalize_angle(pose.theta) + kPi) / kTwoPi * headings);
  return {static_cast<std::int64_t>(std::floor(pose.x / o.cell_m)),
          static_cast<std::int64_t>(std::floor(pose.y / o.cell_m)),
          static_cast<std::int64_t>(std::min(turn, headings - 1.0))};
}

// Two pieces of one cloud that the grid has cut lie 1.3 (two halves of a normal one) to 1.7 (of a uniform
// one) of the sum of their standard deviations apart, and a tail with a hundredth of the weight 2.1; between
// two normal ones that are 2.5 apart the density falls to a tenth.
bool hang_together(const Piece& a, const Piece& b, double sigmas) {
  const auto within = [&](double apart, double spread_a, double spread_b) {
    const double reach = sigmas * (spread_a + spread_b);
    return reach > 0.0 ? (apart / reach) * (apart / reach) : (apart == 0.0 ? 0.0 : 2.0);
  };
  const double turned = normalize_angle(a.mean.theta - b.mean.theta);
  return within(a.mean.x - b.mean.x, a.spread.x, b.spread.x) +
             within(a.mean.y - b.mean.y, a.spread.y, b.spread.y) +
             within(turned, a.spread.theta, b.spread.theta) <
         1.0;
}

bool close(const Piece& a, const Piece& b, const HypothesisOptions& o) {
  const double turned = std::abs(normalize_angle(a.mean.theta - b.mean.theta));
  return (distance(a.mean, b.mean) < o.fuse_m && turned < o.fuse_rad) || hang_together(a, b, o.fuse_sigmas);
}

std::vector<Piece> pieces_of(const std::vector<Group>& cells) {
  std::vector<Piece> pieces;
  pieces.reserve(cells.size());
  for (const Group& cell : cells) pieces.push_back({cell.weight, cell.mean(), cell.spread()});
  return pieces;
}

std::vector<std::size_t> by_weight(const std::vector<Piece>& pieces) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return pieces[a].weight > pieces[b].weight; });
  return order;
}

// Groups are numbered as they are met first.
std::vector<int> numbered(const std::vector<std::size_t>& peak) {
  std::map<std::size_t, int> number;
  std::vector<int> group;
  group.reserve(peak.size());
  for (const std::size_t p : peak)
    group.push_back(number.try_emplace(p, static_cast<int>(number.size())).first->second);
  return group;
}

/// Fuses whatever is close, also over several steps in between, unless there is a valley on the way: from the
/// heaviest piece to the lightest, each joins what it is close to, and joins two groups if it is not much
/// lighter than the lighter one's peak (Chazal et al., JACM 2013: persistence). Returns the group of each
/// piece.
std::vector<int> fuse(const std::vector<Piece>& pieces, const HypothesisOptions& o) {
  const std::vector<std::size_t> order = by_weight(pieces);
  std::vector<std::size_t> peak(pieces.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t piece = order[k];
    peak[piece] = piece;
    for (std::size_t h = 0; h < k; ++h) {
      if (!close(pieces[piece], pieces[order[h]], o)) continue;
      const std::size_t met = peak[order[h]], own = peak[piece];
      if (met == own) continue;
      if (own == piece) {
        peak[piece] = met;
        continue;
      }
      const std::size_t lighter = pieces[met].weight < pieces[own].weight ? met : own;
      if (pieces[piece].weight < o.valley * pieces[lighter].weight) continue;
      std::replace(peak.begin(), peak.end(), lighter, met == lighter ? own : met);
    }
  }
  return numbered(peak);
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
  v.number(
      {"fuse_sigmas", "or nearer than this many times the sum of their standard deviations; 0: no such rule"},
      fuse_sigmas, {0.0, 100.0});
  v.number(
      {"valley", "what is close to two groups joins them if it has this share of the lighter one's peak"},
      valley, {0.0, 1.0});
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
  const std::vector<int> group = fuse(pieces_of(heavy), options);
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
