#include "cairn/models/sensor/ndt_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cairn {
namespace {

constexpr double kExplainedSigmas = 3.0;

}  // namespace

void NdtModelOptions::visit(OptionVisitor& v) {
  v.number({"cell_size_m", "cells of the map, where it is derived from a grid, metres"}, cell_size_m,
           {0.05, 10.0});
  v.number({"z_hit", "weight of the beams that end at a wall of the map"}, z_hit, {0.0, 1.0});
  v.number({"z_rand", "weight of the beams that end anywhere"}, z_rand, {1e-9, 1.0});
  v.number({"sigma_hit_m", "noise of the end points, standard deviation, metres"}, sigma_hit_m, {1e-3, 10.0});
  v.integer({"max_beams",
             "evaluated beams per scan, spread evenly over the valid ones; 0: all",
             {"laser_max_beams"}},
            max_beams, {0, 100000});
  v.number({"effective_beams", "a scan never counts for more than this many independent beams"},
           effective_beams, {0.1, 100000});
}

// The distributions with the noise of the beams, inverted.
struct NdtModel::Table {
  struct Entry {
    Point2 mean;
    double xx, xy, yy;  ///< inverse covariance
    double weight;
  };

  Table(std::shared_ptr<const NdtMap> given, NdtKind kind, double sigma_m)
      : map(std::move(given)), T_ndt_map(inverse(map->geometry().T_map_ndt)) {
    const double noise = sigma_m * sigma_m;
    for (const NdtCell& c : map->cells()) {
      const double xx = c.xx + noise, yy = c.yy + noise;
      const double determinant = xx * yy - c.xy * c.xy;
      entries.push_back({c.mean, yy / determinant, -c.xy / determinant, xx / determinant,
                         (kind == NdtKind::kOndt ? c.occupancy : 1.0) / NdtGeometry::kLayers});
    }
  }

  double squared_distance(std::int32_t number, const Point2& p) const {
    const Entry& e = entries[static_cast<std::size_t>(number)];
    const double dx = p.x - e.mean.x, dy = p.y - e.mean.y;
    return e.xx * dx * dx + 2.0 * e.xy * dx * dy + e.yy * dy * dy;
  }

  double likelihood(const Point2& p) const {
    double sum = 0.0;
    for (const std::int32_t n : map->around(p)) {
      if (n == NdtMap::kNone) continue;
      sum += entries[static_cast<std::size_t>(n)].weight * std::exp(-0.5 * squared_distance(n, p));
    }
    return sum;
  }

  // likelihood() and its derivative by x and y.
  Eigen::Vector3d likelihood_and_slope(const Point2& p) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::int32_t n : map->around(p)) {
      if (n == NdtMap::kNone) continue;
      const Entry& e = entries[static_cast<std::size_t>(n)];
      const double dx = p.x - e.mean.x, dy = p.y - e.mean.y;
      const double f = e.weight * std::exp(-0.5 * squared_distance(n, p));
      sum += f * Eigen::Vector3d(1.0, -(e.xx * dx + e.xy * dy), -(e.xy * dx + e.yy * dy));
    }
    return sum;
  }

  bool explains(const Point2& p) const {
    const auto around = map->around(p);
    return std::any_of(around.begin(), around.end(), [&](std::int32_t n) {
      return n != NdtMap::kNone && squared_distance(n, p) <= kExplainedSigmas * kExplainedSigmas;
    });
  }

  std::shared_ptr<const NdtMap> map;
  Pose2 T_ndt_map;
  std::vector<Entry> entries;
};

NdtModel::NdtModel(std::shared_ptr<const NdtMap> map, NdtKind kind, const Pose2& T_base_sensor,
                   const BeamLimits& limits, const NdtModelOptions& options)
    : table_(std::make_shared<const Table>(std::move(map), kind, options.sigma_hit_m)),
      T_base_sensor_(T_base_sensor),
      limits_(limits),
      options_(options) {}

// The beams of one scan.
struct NdtModel::Beams {
  std::shared_ptr<const Table> table;
  std::vector<Point2> points;  ///< in the robot's base frame
  double scale, z_hit, z_rand;

  void score(std::span<const Pose2> states, std::span<double> out) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Pose2 T_ndt_base = table->T_ndt_map * states[i];
      const double c = std::cos(T_ndt_base.theta), s = std::sin(T_ndt_base.theta);
      double sum = 0.0;
      for (const Point2& p : points) {
        const Point2 end{T_ndt_base.x + c * p.x - s * p.y, T_ndt_base.y + s * p.x + c * p.y};
        sum += std::log(z_hit * table->likelihood(end) + z_rand);
      }
      out[i] = scale * sum;
    }
  }

  void differentiate(std::span<const Pose2> states, std::span<Eigen::Vector3d> out) const {
    const double c_map = std::cos(table->T_ndt_map.theta), s_map = std::sin(table->T_ndt_map.theta);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Eigen::Vector3d g = slope_in_ndt(table->T_ndt_map * states[i]);
      // From the axes of the NDT map to those of the map: the inverse turn.
      out[i] = scale * Eigen::Vector3d(c_map * g.x() + s_map * g.y(), -s_map * g.x() + c_map * g.y(), g.z());
    }
  }

 private:
  // Derivative by x, y and heading of T_ndt_base.
  Eigen::Vector3d slope_in_ndt(const Pose2& T_ndt_base) const {
    const double c = std::cos(T_ndt_base.theta), s = std::sin(T_ndt_base.theta);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Point2& p : points) {
      const Point2 arm{c * p.x - s * p.y, s * p.x + c * p.y};
      const Eigen::Vector3d f = table->likelihood_and_slope({T_ndt_base.x + arm.x, T_ndt_base.y + arm.y});
      const double factor = z_hit / (z_hit * f[0] + z_rand);
      sum += factor * Eigen::Vector3d(f[1], f[2], arm.x * f[2] - arm.y * f[1]);
    }
    return sum.allFinite() ? sum : Eigen::Vector3d::Zero();  // a state that is not finite has no direction
  }
};

BoundUpdate<Pose2> NdtModel::bind(const LaserScan& scan) const {
  auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const double count = std::max<double>(1.0, static_cast<double>(points.size()));
  const double scale = std::min(1.0, options_.effective_beams / count);
  const auto beams =
      std::make_shared<const Beams>(Beams{table_, std::move(points), scale, options_.z_hit, options_.z_rand});
  BoundUpdate<Pose2> update;
  update.stamp = scan.stamp;
  update.log_likelihood = [beams](auto states, auto out) { beams->score(states, out); };
  update.gradient = [beams](auto states, auto out) { beams->differentiate(states, out); };
  return update;
}

double NdtModel::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const auto points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const Pose2 T_ndt_base = table_->T_ndt_map * T_map_base;
  const auto explained = std::count_if(points.begin(), points.end(),
                                       [&](const Point2& p) { return table_->explains(T_ndt_base * p); });
  return points.empty() ? 0.0 : static_cast<double>(explained) / static_cast<double>(points.size());
}

}  // namespace cairn
