// How long recipes keep all four poses of a symmetric cross, and how exact each of them is.
//
//   cairn_mode_survival [SEEDS] [UPDATES] [RECIPE ...] [key=value ...]
//
// A cross of 15 m x 15 m, arms 2 m wide, looks the same from all four quarters. The robot drives to and fro
// through the crossing in the middle and turns at the ends; a scanner (180 degrees, 60 beams, 1 cm noise) is
// weighed by the likelihood field. At most 500 particles. Keys are those of `cairn config`. Prints one row
// per run: recipe, seed, the update after which the first pose had died out (or all of them: none had), the
// mean distance (cm) of the four poses' means from the truth until then.
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace cairn {
namespace {

constexpr int kModes = 4;
constexpr double kArm_m = 7.5, kHalfWidth_m = 1.0, kCell_m = 0.05;
constexpr double kNoise_m = 0.01;
constexpr double kNear_m = 0.6, kNear_rad = 0.6;

OccupancyGrid cross() {
  constexpr int kSize = 321;  // odd, the middle of the middle cell at the origin: symmetric to the cell
  const GridGeometry grid{kSize, kSize, kCell_m, {-0.5 * kSize * kCell_m, -0.5 * kSize * kCell_m, 0.0}};
  std::vector<OccupancyGrid::Cell> cells(grid.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const Point2 p = grid.center(column, row);
      const double x = std::abs(p.x), y = std::abs(p.y);
      const auto within = [&](double arm, double half) {
        return (x < arm && y < half) || (y < arm && x < half);
      };
      if (within(kArm_m + kCell_m, kHalfWidth_m + kCell_m))
        cells[grid.index(column, row)] = within(kArm_m, kHalfWidth_m) ? 0 : 100;
    }
  }
  return {grid, std::move(cells)};
}

// From the bar along x to the walls themselves. (Cast in the map, rays end at the near side of a cell, before
// its middle, where the likelihood field has the wall: all poses were 3 cm ahead.)
double range_to_wall(const Pose2& pose, double bearing_rad) {
  const double dx = std::cos(pose.theta + bearing_rad), dy = std::sin(pose.theta + bearing_rad);
  const auto out_of = [](double from, double direction, double half) {
    return std::abs(direction) < 1e-9 ? 1e9 : (std::copysign(half, direction) - from) / direction;
  };
  const double sideways = out_of(pose.y, dy, kHalfWidth_m);
  const bool into_the_other_bar = std::abs(pose.x + sideways * dx) < kHalfWidth_m;
  return into_the_other_bar ? std::min(out_of(pose.x, dx, kHalfWidth_m), out_of(pose.y, dy, kArm_m))
                            : std::min(out_of(pose.x, dx, kArm_m), sideways);
}

// 0.1 m or 10 degrees a step; once around in 316.
Pose2 truth(int step) {
  constexpr int kDrive = 130, kTurn = 18;
  const int at = step % (2 * (kDrive + kTurn));
  const int half = at % (kDrive + kTurn);
  const Pose2 along{-6.5 + 0.1 * std::min(half, kDrive), 0.0, kPi / kTurn * std::max(0, half - kDrive)};
  return at == half ? along : Pose2{0.0, 0.0, kPi} * along;
}

Pose2 turned(const Pose2& pose, int quarter) { return Pose2{0.0, 0.0, quarter * kPi / 2.0} * pose; }

class World {
 public:
  explicit World(const LikelihoodFieldOptions& model)
      : map_(cross()), model_(std::make_shared<const DistanceField>(map_, 2.0), {}, {}, model) {
    for (int k = 0; k < 60; ++k) bearings_.push_back(-kPi / 2.0 + kPi * (k + 0.5) / 60.0);
  }
  const OccupancyGrid& map() const { return map_; }

  BoundUpdate<Pose2> scan(int step, std::uint64_t seed) const {
    const Pose2 pose = truth(step);
    LaserScan scan;
    scan.angle_min_rad = bearings_[0];
    scan.angle_increment_rad = bearings_[1] - bearings_[0];
    scan.range_max_m = 29.0;
    scan.ranges_m.resize(bearings_.size());
    const RandomStream random(seed, RandomPurpose::kInitialize, static_cast<std::uint64_t>(step) + 1);
    for (std::uint32_t k = 0; k < scan.ranges_m.size(); ++k)
      scan.ranges_m[k] =
          static_cast<float>(range_to_wall(pose, bearings_[k]) + kNoise_m * random.normal4(k)[0]);
    return model_.bind(scan);
  }

 private:
  OccupancyGrid map_;
  LikelihoodField model_;
  std::vector<double> bearings_;
};

struct Run {
  int lost_after = 0;
  double error_m = 0.0;
};

// Weighted mean of the particles near a pose; false if there are none.
bool mean_near(const ParticleSet<Pose2>& particles, const Pose2& mode, double& error_m) {
  double weight = 0.0, x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Pose2& p = particles.states[i];
    if (distance(p, mode) >= kNear_m || std::abs(normalize_angle(p.theta - mode.theta)) >= kNear_rad)
      continue;
    const double w = std::exp(particles.log_weights[i]);
    weight += w, x += w * (p.x - mode.x), y += w * (p.y - mode.y);
  }
  if (weight <= 0.0) return false;
  error_m += std::hypot(x, y) / weight;
  return true;
}

Run run(const World& world, LocalizerOptions options, const std::string& recipe, int updates,
        std::uint64_t seed) {
  options.recipe = recipe;
  options.filter.particles = 500;
  options.filter.min_particles = 400;
  options.filter.max_particles = 500;
  auto filter = make_filter(options, seed, std::make_shared<const Executor>(), &world.map());
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return turned(truth(0) * Pose2{0.1 * n[0], 0.1 * n[1], 0.1 * n[2]}, static_cast<int>(i % kModes));
  });
  double sum_m = 0.0;
  for (int step = 1; step <= updates; ++step) {
    filter.update(between(truth(step - 1), truth(step)), world.scan(step, seed));
    for (int quarter = 0; quarter < kModes; ++quarter) {
      if (!mean_near(filter.particles(), turned(truth(step), quarter), sum_m))
        return {step, sum_m / std::max(1, kModes * (step - 1))};
    }
  }
  return {updates, sum_m / (kModes * updates)};
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10;
  const int updates = argc > 2 ? std::atoi(argv[2]) : 10'000;
  std::vector<std::string> recipes, settings;
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    (word.find('=') == std::string::npos ? recipes : settings).push_back(word);
  }
  if (recipes.empty()) recipes = {"mcl", "kld_mcl", "csrl", "ckld_srl", "ckld_mcl"};
  cairn::LocalizerOptions options;
  try {
    cairn::apply_settings(settings, [&](cairn::OptionVisitor& visitor) { options.visit(visitor); });
  } catch (const cairn::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  const cairn::World world(options.laser.likelihood_field);
  std::cout << "recipe,seed,updates,lost_after,error_cm\n";
  for (const std::string& recipe : recipes) {
    for (int seed = 1; seed <= seeds; ++seed) {
      const cairn::Run result = cairn::run(world, options, recipe, updates, static_cast<std::uint64_t>(seed));
      std::cout << recipe << ',' << seed << ',' << updates << ',' << result.lost_after << ','
                << 100.0 * result.error_m << std::endl;
    }
  }
}
