// Writes the run directories that the browser test opens: a made-up drive of five minutes through a small
// office. usage: make_run full|no_reference|hostile|bare DIR
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>
#include <string>

namespace {

using namespace cairn;

constexpr double kSpan = 300.0;
constexpr double kPeriod = 0.2;
constexpr double kResolution = 0.05;
constexpr const char* kHostile = "</script><img src=x onerror=\"window.attacked=true\">";

struct Box {
  double left, bottom, right, top;
};

// Walls of a 24 m x 14 m floor: two rows of rooms along a corridor, with doors.
std::vector<Box> walls() {
  std::vector<Box> boxes = {{0, 0, 24, 0.2}, {0, 13.8, 24, 14}, {0, 0, 0.2, 14}, {23.8, 0, 24, 14}};
  for (int room = 0; room < 4; ++room) {
    const double x = 6.0 * room;
    for (const double y : {5.8, 8.0}) {
      boxes.push_back({x, y, x + 2.4, y + 0.15});
      boxes.push_back({x + 3.6, y, x + 6.0, y + 0.15});
    }
    if (room > 0) boxes.push_back({x, 0, x + 0.15, 5.8});
    if (room > 0) boxes.push_back({x, 8.15, x + 0.15, 14});
    boxes.push_back({x + 1.0, 1.2, x + 2.2, 2.0});
    boxes.push_back({x + 4.0, 12.0, x + 5.4, 12.8});
  }
  return boxes;
}

std::shared_ptr<const OccupancyGrid> office(double yaw) {
  const double margin = 1.0;
  GridGeometry g{520, 320, kResolution, Pose2{0, 0, yaw} * Pose2{-margin, -margin, 0}};
  std::vector<OccupancyGrid::Cell> cells(g.size(), OccupancyGrid::kUnknown);
  const auto fill = [&](const Box& box, OccupancyGrid::Cell value) {
    const auto cell = [&](double metres) {
      return static_cast<int>(std::lround((metres + margin) / kResolution));
    };
    for (int row = cell(box.bottom); row < cell(box.top); ++row) {
      for (int column = cell(box.left); column < cell(box.right); ++column)
        cells[g.index(column, row)] = value;
    }
  };
  fill({0, 0, 24, 14}, 0);
  for (const Box& wall : walls()) fill(wall, 100);
  return std::make_shared<OccupancyGrid>(g, std::move(cells));
}

// Rounds between the rooms: along the corridor, in at each door and out again.
Point2 truth_position(double t) {
  const double along = 12.0 - 10.4 * std::cos(2.0 * std::numbers::pi * t / 150.0);
  const double room = std::fmod(along, 6.0) - 3.0;
  const double visit = std::exp(-room * room / 0.12);
  const double side = std::fmod(t, 150.0) < 75.0 ? 1.0 : -1.0;
  return {along, 7.0 + side * (0.35 + 2.6 * visit)};
}

Pose2 truth(double t) {
  const Point2 p = truth_position(t);
  const Point2 q = truth_position(t + 0.05);
  return {p.x, p.y, std::atan2(q.y - p.y, q.x - p.x)};
}

class Office {
 public:
  explicit Office(double yaw) : T_map_office_{0, 0, yaw} {}

  app::RunData drive();

 private:
  double uniform() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
  }
  double sigma(double t) const {
    return 0.02 + 0.25 * std::exp(-t / 3.0) + 0.06 * std::exp(-std::pow((t - 180.0) / 8.0, 2));
  }
  Estimate estimate(double t);
  ParticleSnapshot cloud(const Estimate& e);

  Pose2 T_map_office_;
  std::mt19937 engine_{7};
  std::array<double, 3> drift_{};
};

Estimate Office::estimate(double t) {
  for (double& d : drift_) d = 0.95 * d + 0.31 * normal();
  const double s = sigma(t);
  Estimate e;
  e.stamp = time_from_seconds(1000.0 + t);
  const Pose2 error{0.8 * s * drift_[0], 0.5 * s * drift_[1], 0.15 * s * drift_[2]};
  e.T_map_base = T_map_office_ * truth(t) * error;
  const double c = std::cos(e.T_map_base.theta);
  const double n = std::sin(e.T_map_base.theta);
  const double major = 0.64 * s * s;
  const double minor = 0.25 * s * s;
  e.covariance << c * c * major + n * n * minor, c * n * (major - minor), 0, c * n * (major - minor),
      n * n * major + c * c * minor, 0, 0, 0, 0.0225 * s * s;
  e.particles = std::clamp(static_cast<int>(500 + 6000 * (s - 0.02)), 500, 2000);
  e.ess = e.particles * (0.45 + 0.08 * drift_[0]);
  e.hypotheses = t < 4.0 ? 3 : 1;
  e.weight = t < 4.0 ? 0.6 : 1.0;
  e.quality = std::clamp(0.93 - 2.0 * (s - 0.02) + 0.02 * drift_[1], 0.0, 1.0);
  return e;
}

ParticleSnapshot Office::cloud(const Estimate& e) {
  ParticleSnapshot snapshot{e.stamp, {}};
  const double s = std::sqrt(e.covariance(2, 2)) / 0.15;
  for (int i = 0; i < 150; ++i) {
    snapshot.particles.push_back(e.T_map_base *
                                 Pose2{0.8 * s * normal(), 0.5 * s * normal(), 0.15 * s * normal()});
  }
  return snapshot;
}

app::RunData Office::drive() {
  app::RunData run;
  run.reference.emplace();
  const int steps = static_cast<int>(kSpan / kPeriod);
  for (int i = 0; i <= steps; ++i) {
    const double t = kPeriod * i;
    run.estimates.push_back(estimate(t));
    run.trajectory.push_back({run.estimates.back().stamp, run.estimates.back().T_map_base});
    run.reference->push_back({run.estimates.back().stamp, T_map_office_ * truth(t)});
    if (i % 5 == 0) run.particles.push_back(cloud(run.estimates.back()));
  }
  run.map = office(T_map_office_.theta);
  run.configuration = "recipe: kld_mcl\nmotion:\n  alpha1: 0.1\nlaser:\n  beams: 60\n  sigma_hit_m: 0.1\n";
  return run;
}

nlohmann::json metrics(const std::string& name) {
  using nlohmann::json;
  return {
      {"cairn_version", CAIRN_VERSION},
      {"recipe", "kld_mcl"},
      {"seed", 1},
      {"threads", 2},
      {"verdict", "tracking"},
      {"verdict_reason", "the map explains 93 % of the beams of the last 20 scans"},
      {"interrupted", false},
      {"log",
       {{"path", "logs/" + name},
        {"format", "carmen"},
        {"span_s", kSpan},
        {"streams",
         {{{"name", name}, {"kind", "laser_scan"}, {"messages", 3001}},
          {{"name", "odom"}, {"kind", "odometry"}, {"messages", 6002}}}}}},
      {"map",
       {{"path", "maps/" + name + ".yaml"}, {"width", 520}, {"height", 320}, {"resolution_m", kResolution}}},
      {"accuracy",
       {{"matched", 1501},
        {"ate_mean_m", 0.0274},
        {"ate_std_m", 0.021},
        {"ate_rmse_m", 0.0345},
        {"ate_median_m", 0.022},
        {"ate_p95_m", 0.071},
        {"ate_max_m", 0.321},
        {"heading_mean_rad", 0.0041},
        {"heading_max_rad", 0.061},
        {"lost", false}}},
      {"outcomes",
       {{name, {{"used", 1501}, {"not_needed", 1490}, {"dropped_no_odometry", 10}, {"dropped_malformed", 0}}},
        {"odom", {{"used", 5998}, {"dropped_out_of_order", 4}}}}},
      {"updates", 1501},
      {"timings",
       {{"read_s", 0.21},
        {"prepare_s", 0.05},
        {"run_s", 0.62},
        {"total_s", 0.88},
        {"realtime_factor", 340.9},
        {"update_mean_ms", 0.31}}},
      {"peak_memory_bytes", 48234496},
      {"warnings", {{name, 3}, {"time reversal", 4}}},
  };
}

app::RunData make(const std::string& kind) {
  app::RunData run = Office(kind == "hostile" ? 0.35 : 0.0).drive();
  run.metrics = metrics(kind == "hostile" ? kHostile : "office");
  if (kind == "hostile") run.configuration = std::string(kHostile) + "<!--" + kHostile + "\n";
  if (kind == "no_reference") {
    run.reference.reset();
    run.metrics.erase("accuracy");
  }
  if (kind == "bare") {
    run = {};
    run.metrics = {{"cairn_version", CAIRN_VERSION}};
  }
  return run;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: make_run full|no_reference|hostile|bare DIR\n";
    return 2;
  }
  cairn::app::write_run(argv[2], make(argv[1]));
  return 0;
}
