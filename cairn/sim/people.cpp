#include "cairn/sim/people.hpp"

#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

constexpr double kFrame_s = 0.1;
constexpr int kStepsPerFrame = 2;
constexpr double kStep_s = kFrame_s / kStepsPerFrame;

// The model's constants, after Helbing & Molnar: time to reach the wished speed, strength and reach of the
// repulsion.
constexpr double kRelaxation_s = 0.5;
constexpr double kRepulsion_mps2 = 4.0;
constexpr double kReach_m = 0.3;
constexpr double kFastest = 1.3;  // times the wished speed
constexpr double kThere_m = 0.4;
constexpr int kDirections = 64;  // tried around the robot

Point2 operator+(const Point2& a, const Point2& b) { return {a.x + b.x, a.y + b.y}; }
Point2 operator-(const Point2& a, const Point2& b) { return {a.x - b.x, a.y - b.y}; }
Point2 operator*(double s, const Point2& p) { return {s * p.x, s * p.y}; }
double length(const Point2& p) { return std::hypot(p.x, p.y); }
Point2 unit(const Point2& p) {
  const double n = length(p);
  return n > 1e-9 ? (1.0 / n) * p : Point2{1.0, 0.0};
}

struct Walker {
  Point2 position;
  Point2 velocity;
  double wished_mps = 1.0;
  std::vector<Point2> way;  // corners still to go
  std::uint64_t chosen = 0;
};

const Point2& pick(const std::vector<Point2>& points, double u) {
  return points[std::min(points.size() - 1,
                         static_cast<std::size_t>(u * static_cast<double>(points.size())))];
}

class Walk {
 public:
  Walk(const World& world, const Point2& robot, std::uint64_t seed)
      : world_(world),
        seed_(seed),
        options_(world.options.people),
        touching_m_(options_.radius_m + world.options.robot.radius_m) {
    for (int i = 0; i < options_.walking; ++i) {
      const auto n =
          simulation_random(seed, SimulationUse::kWalking, 0).normal4(static_cast<std::uint32_t>(i));
      const auto u =
          simulation_random(seed, SimulationUse::kWalking, 0).uniform4(static_cast<std::uint32_t>(i), 1);
      const double speed = options_.speed_mps * std::clamp(1.0 + 0.2 * n[0], 0.5, 1.5);
      walkers_.push_back({pick(world.planner.free_points(), u[0]), {}, speed, {}, 0});
      make_room(walkers_.back(), robot);
    }
  }

  void step(const Point2& robot) {
    for (std::size_t i = 0; i < walkers_.size(); ++i) choose_goal(i);
    std::vector<Point2> forces;
    for (std::size_t i = 0; i < walkers_.size(); ++i) forces.push_back(force_on(i, robot));
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      move(walkers_[i], forces[i]);
      make_room(walkers_[i], robot);
    }
  }

  std::vector<Point2> positions() const {
    std::vector<Point2> all;
    for (const Walker& walker : walkers_) all.push_back(walker.position);
    return all;
  }

 private:
  void choose_goal(std::size_t i) {
    Walker& walker = walkers_[i];
    while (!walker.way.empty() && length(walker.way.front() - walker.position) < kThere_m) {
      walker.way.erase(walker.way.begin());
    }
    if (!walker.way.empty()) return;
    ++walker.chosen;
    const double u = simulation_random(seed_, SimulationUse::kWalking, walker.chosen)
                         .uniform(static_cast<std::uint32_t>(i));
    const auto way = world_.planner.route(walker.position, pick(world_.planner.free_points(), u));
    if (way) walker.way = *way;
  }

  Point2 force_on(std::size_t i, const Point2& robot) const {
    const Walker& walker = walkers_[i];
    const Point2 wished =
        walker.way.empty() ? Point2{} : walker.wished_mps * unit(walker.way.front() - walker.position);
    Point2 force = (1.0 / kRelaxation_s) * (wished - walker.velocity);
    for (std::size_t k = 0; k < walkers_.size(); ++k) {
      if (k != i) force = force + repulsion(walker.position, walkers_[k].position, 2.0 * options_.radius_m);
    }
    return force + repulsion(walker.position, robot, touching_m_);
  }

  static Point2 repulsion(const Point2& at, const Point2& from, double touching_m) {
    const Point2 away = at - from;
    const double strength = kRepulsion_mps2 * std::exp((touching_m - length(away)) / kReach_m);
    return std::min(strength, 20.0) * unit(away);
  }

  // Walls end every motion into them: the planner's free cells keep a robot's radius from walls.
  void move(Walker& walker, const Point2& force) const {
    Point2 velocity = walker.velocity + kStep_s * force;
    const double most = kFastest * walker.wished_mps;
    if (length(velocity) > most) velocity = most * unit(velocity);
    const Point2 next = walker.position + kStep_s * velocity;
    const Point2 along_x{next.x, walker.position.y}, along_y{walker.position.x, next.y};
    walker.velocity = velocity;
    if (world_.planner.is_free(next)) {
      walker.position = next;
    } else if (world_.planner.is_free(along_x)) {
      walker.position = along_x;
    } else if (world_.planner.is_free(along_y)) {
      walker.position = along_y;
    } else {
      walker.velocity = {};
    }
  }

  // Nobody is inside the robot: the force alone lets it drive into who cannot give way fast enough. Who is
  // touched goes to the nearest place beside the robot that is free, and stays only if none is.
  void make_room(Walker& walker, const Point2& robot) const {
    const Point2 away = walker.position - robot;
    if (length(away) >= touching_m_) return;
    const double straight = std::atan2(away.y, away.x);
    for (int i = 0; i <= kDirections; ++i) {
      const int turns = (i + 1) / 2;
      const double turned = 2.0 * std::numbers::pi / kDirections * turns;
      const double angle = straight + (i % 2 == 0 ? turned : -turned);
      const Point2 beside = robot + touching_m_ * Point2{std::cos(angle), std::sin(angle)};
      if (!world_.planner.is_free(beside)) continue;
      walker.position = beside;
      return;
    }
  }

  const World& world_;
  std::uint64_t seed_;
  WorldPeopleOptions options_;
  double touching_m_;
  std::vector<Walker> walkers_;
};

}  // namespace

People::People(const World& world, const Trajectory& robot, std::uint64_t seed)
    : options_(world.options.people), robot_(robot) {
  place_standing(world, robot, seed);
  walk(world, robot, seed);
}

void People::place_standing(const World& world, const Trajectory& robot, std::uint64_t seed) {
  const double distance_m = options_.radius_m + world.options.robot.radius_m + 0.1;
  constexpr std::size_t kEvery = 10;  // poses of the robot, 0.2 s
  const auto in_the_way = [&](const Point2& p) {
    for (std::size_t i = 0; i < robot.size(); i += kEvery) {
      if (std::hypot(robot[i].pose.x - p.x, robot[i].pose.y - p.y) < distance_m) return true;
    }
    return false;
  };
  const auto wanted = static_cast<std::size_t>(options_.standing);
  for (std::uint64_t step = 0; standing_.size() < wanted && step < 100 * wanted; ++step) {
    const Point2& p =
        pick(world.planner.free_points(), simulation_random(seed, SimulationUse::kPeople, step).uniform(0));
    if (!in_the_way(p)) standing_.push_back(p);
  }
}

void People::walk(const World& world, const Trajectory& robot, std::uint64_t seed) {
  if (options_.walking == 0) return;
  const double end_s = to_seconds(robot.back().stamp);
  const auto robot_at = [&](double t) {
    const auto pose = pose_at(robot, Time{} + duration_from_seconds(std::min(t, end_s)));
    return Point2{pose->x, pose->y};
  };
  Walk walk(world, robot_at(0.0), seed);
  for (double t = 0.0; t <= end_s + kFrame_s; t += kFrame_s) {
    frames_.push_back(walk.positions());
    for (int i = 1; i <= kStepsPerFrame; ++i) walk.step(robot_at(t + i * kStep_s));
  }
}

void People::add_crowd(double time_s, std::vector<Cylinder>& all) const {
  if (options_.crowd == 0 || time_s < options_.crowd_from_s || time_s > options_.crowd_to_s) return;
  const auto pose = pose_at(robot_, std::min(robot_.back().stamp, Time{} + duration_from_seconds(time_s)));
  if (!pose) return;
  for (int i = 0; i < options_.crowd; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / options_.crowd;
    const double sway = 0.1 * std::sin(0.7 * time_s + i);
    all.push_back({{pose->x + options_.crowd_distance_m * std::cos(angle + sway),
                    pose->y + options_.crowd_distance_m * std::sin(angle + sway)},
                   options_.radius_m});
  }
}

std::vector<Cylinder> People::at(double time_s) const {
  std::vector<Cylinder> all;
  for (const Point2& p : standing_) all.push_back({p, options_.radius_m});
  if (!frames_.empty()) {
    const double frame = std::max(0.0, time_s / kFrame_s);
    const std::size_t i = std::min(frames_.size() - 1, static_cast<std::size_t>(frame));
    const std::size_t next = std::min(frames_.size() - 1, i + 1);
    const double s = std::clamp(frame - static_cast<double>(i), 0.0, 1.0);
    for (std::size_t k = 0; k < frames_[i].size(); ++k) {
      const Point2 &a = frames_[i][k], &b = frames_[next][k];
      all.push_back({{std::lerp(a.x, b.x, s), std::lerp(a.y, b.y, s)}, options_.radius_m});
    }
  }
  add_crowd(time_s, all);
  return all;
}

}  // namespace cairn
