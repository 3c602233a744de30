#include "cairn/bayes/clustering.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace cairn {
namespace {

using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

struct CellContent {
  double weight = 0.0;
  int cluster = -1;
};

class PoseGrid {
 public:
  explicit PoseGrid(const ClusterOptions& options)
      : cell_m_(options.cell_m),
        headings_(std::max<std::int64_t>(1, std::llround(kTwoPi / options.cell_rad))) {}

  Cell cell_of(const Pose2& pose) const {
    const auto turn =
        static_cast<std::int64_t>(std::floor(pose.theta / kTwoPi * static_cast<double>(headings_)));
    return {static_cast<std::int64_t>(std::floor(pose.x / cell_m_)),
            static_cast<std::int64_t>(std::floor(pose.y / cell_m_)), wrap(turn)};
  }

  template <class Visit>
  void for_neighbours(const Cell& cell, const Visit& visit) const {
    const auto [x, y, h] = cell;
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dh = -1; dh <= 1; ++dh) visit(Cell{x + dx, y + dy, wrap(h + dh)});
      }
    }
  }

 private:
  std::int64_t wrap(std::int64_t h) const { return ((h % headings_) + headings_) % headings_; }
  double cell_m_;
  std::int64_t headings_;
};

// Spreads `cluster` from `start` over the neighbouring cells that have weight. Returns the weight gathered.
double flood(std::map<Cell, CellContent>& cells, const PoseGrid& grid, const Cell& start, int cluster,
             double min_weight) {
  double weight = 0.0;
  std::vector<Cell> open = {start};
  cells[start].cluster = cluster;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    weight += cells[cell].weight;
    grid.for_neighbours(cell, [&](const Cell& next) {
      const auto found = cells.find(next);
      if (found == cells.end() || found->second.cluster >= 0 || found->second.weight < min_weight) return;
      found->second.cluster = cluster;
      open.push_back(next);
    });
  }
  return weight;
}

// order[i]: the rank of cluster i by weight, heaviest 0 (equal weights: first found first).
std::vector<int> ranks(const std::vector<double>& weights) {
  std::vector<int> order(weights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weights[a] > weights[b]; });
  std::vector<int> rank(weights.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<int>(i);
  return rank;
}

}  // namespace

Clusters cluster_poses(std::span<const Pose2> poses, std::span<const double> weights,
                       const ClusterOptions& options) {
  CAIRN_ASSERT(poses.size() == weights.size());
  const PoseGrid grid(options);
  std::map<Cell, CellContent> cells;  // ordered, so that the clusters do not depend on hashing
  double total = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    cells[grid.cell_of(poses[i])].weight += weights[i];
    total += weights[i];
  }
  const double min_weight = options.min_cell_weight * total;
  std::vector<double> found;
  for (const auto& [cell, content] : cells) {
    if (content.cluster >= 0 || content.weight < min_weight) continue;
    found.push_back(flood(cells, grid, cell, static_cast<int>(found.size()), min_weight) / total);
  }
  const std::vector<int> rank = ranks(found);
  Clusters clusters;
  clusters.weight.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) clusters.weight[rank[i]] = found[i];
  clusters.label.reserve(poses.size());
  for (const Pose2& pose : poses) {
    const int cluster = cells[grid.cell_of(pose)].cluster;
    clusters.label.push_back(cluster < 0 ? -1 : rank[cluster]);
  }
  return clusters;
}

}  // namespace cairn
