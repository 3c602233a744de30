#include "cairn/models/sensor/likelihood_field.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kExplainedSigmas = 3.0;

double square(double x) { return x * x; }

}  // namespace

void LikelihoodFieldOptions::visit(OptionVisitor& v) {
  v.number({"z_hit", "weight of the beams that end at a wall of the map", {"laser_z_hit"}}, z_hit,
           {0.0, 1.0});
  v.number({"z_rand", "weight of the beams that end anywhere", {"laser_z_rand"}}, z_rand, {1e-9, 1.0});
  v.number({"sigma_hit_m",
            "standard deviation of the end points' distance to the wall, metres",
            {"sigma_hit", "laser_sigma_hit"}},
           sigma_hit_m, {1e-3, 10.0});
  v.number({"max_distance_m",
            "distances to the nearest wall beyond this count as this, metres",
            {"laser_likelihood_max_dist"}},
           max_distance_m, {0.01, 100.0});
  v.integer({"max_beams",
             "evaluated beams per scan, spread evenly over the valid ones; 0: all",
             {"laser_max_beams"}},
            max_beams, {0, 100000});
  v.number({"effective_beams", "a scan never counts for more than this many independent beams"},
           effective_beams, {0.1, 100000});
}

// Log-likelihood of an end point per cell, with a border of one cell that stands for everything off the map.
struct LikelihoodField::Table {
  Table(const DistanceField& field, const LikelihoodFieldOptions& options);

  float at(double column, double row) const {
    // Clamped into the border as floating point, so that no far-away value overflows an index. In this order
    // min() takes what is not a number to the border, too.
    const auto c = static_cast<std::size_t>(std::max(0.0, std::min(last_column, column + 1.0)));
    const auto r = static_cast<std::size_t>(std::max(0.0, std::min(last_row, row + 1.0)));
    return log_likelihood[r * stride + c];
  }

  Pose2 T_grid_map;
  double cells_per_m;
  double last_column;
  double last_row;
  std::size_t stride;
  std::vector<float> log_likelihood;
};

LikelihoodField::Table::Table(const DistanceField& field, const LikelihoodFieldOptions& o)
    : T_grid_map(inverse(field.geometry().T_map_grid)),
      cells_per_m(1.0 / field.geometry().resolution_m),
      last_column(field.geometry().width + 1.0),
      last_row(field.geometry().height + 1.0),
      stride(static_cast<std::size_t>(field.geometry().width) + 2) {
  const auto log_p = [&](double d) {
    return static_cast<float>(std::log(o.z_hit * std::exp(-square(d / o.sigma_hit_m) / 2.0) + o.z_rand));
  };
  const auto rows = static_cast<std::size_t>(field.geometry().height);
  const auto columns = static_cast<std::size_t>(field.geometry().width);
  log_likelihood.assign(stride * (rows + 2), log_p(field.max_distance_m()));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      log_likelihood[(row + 1) * stride + column + 1] = log_p(field.distance_m(row * columns + column));
    }
  }
}

LikelihoodField::LikelihoodField(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
                                 const BeamLimits& limits, const LikelihoodFieldOptions& options)
    : field_(std::move(field)),
      table_(std::make_shared<const Table>(*field_, options)),
      T_base_sensor_(T_base_sensor),
      limits_(limits),
      options_(options) {}

BoundUpdate<Pose2> LikelihoodField::bind(const LaserScan& scan) const {
  std::vector<Point2> points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  for (Point2& p : points) p = {p.x * table_->cells_per_m, p.y * table_->cells_per_m};
  const double beams = std::max<double>(1.0, static_cast<double>(points.size()));
  const double scale = std::min(1.0, options_.effective_beams / beams);
  const auto evaluate = [table = table_, points = std::move(points), scale](std::span<const Pose2> states,
                                                                            std::span<double> out) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Pose2 T_grid_base = table->T_grid_map * states[i];
      const double x = T_grid_base.x * table->cells_per_m, y = T_grid_base.y * table->cells_per_m;
      const double c = std::cos(T_grid_base.theta), s = std::sin(T_grid_base.theta);
      double sum = 0.0;
      for (const Point2& p : points) sum += table->at(x + c * p.x - s * p.y, y + s * p.x + c * p.y);
      out[i] = scale * sum;
    }
  };
  return {scan.stamp, evaluate};
}

double LikelihoodField::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const std::vector<Point2> points = select_end_points(scan, T_base_sensor_, limits_, options_.max_beams);
  const GridGeometry& grid = field_->geometry();
  std::size_t explained = 0;
  for (const Point2& p : points) {
    const Point2 cell = grid.to_cells(T_map_base * p);
    if (!(cell.x >= 0 && cell.x < grid.width && cell.y >= 0 && cell.y < grid.height)) continue;
    const float distance =
        field_->distance_m(grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y)));
    explained += distance <= kExplainedSigmas * options_.sigma_hit_m ? 1 : 0;
  }
  return points.empty() ? 0.0 : static_cast<double>(explained) / static_cast<double>(points.size());
}

}  // namespace cairn
