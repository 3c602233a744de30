#include "cairn/sim/mission.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/sim/floor_plan.hpp"
#include "cairn/sim/simulation_random.hpp"
#include "cairn/sim/tour_driver.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::uint64_t kMostStarts = 10'000;  // drawn until one can be reached
constexpr const char* kPointsKey = "robot.points";
constexpr Duration kRandomDrive = std::chrono::seconds(60);
constexpr double kReached_m = 0.1;

std::string text_of(const Point2& p) {
  const auto rounded = [](double v) { return std::to_string(v).substr(0, std::to_string(v).find('.') + 3); };
  return "(" + rounded(p.x) + ", " + rounded(p.y) + ")";
}

void check_free(const World& world, const Point2& point, const char* key) {
  if (world.planner.is_free(point)) return;
  throw ConfigurationError(key,
                           "leads to " + text_of(point) +
                               ", which lies in a wall, nearer to one than the robot's radius, or outside",
                           "move the point, or make robot.radius_m smaller");
}

void check_reachable(const World& world, const Point2& from, const std::vector<Point2>& points) {
  Point2 at = from;
  for (const Point2& next : points) {
    check_free(world, next, kPointsKey);
    if (!world.planner.joins(at, next)) {
      throw ConfigurationError(kPointsKey, "there is no way from " + text_of(at) + " to " + text_of(next),
                               "move the point, open a wall, or make robot.radius_m smaller");
    }
    at = next;
  }
}

// A robot drives at most this far; it leaves out a little of the way at every corner.
bool is_out_of_reach(const World& world, const Point2& from, const std::vector<Point2>& way,
                     Duration duration) {
  if (duration == Duration::zero()) return false;
  constexpr double kLeftOut_m = 4.0 * kReached_m;
  double length = 0.0;
  Point2 at = from;
  for (const Point2& corner : way) {
    length += std::max(0.0, std::hypot(corner.x - at.x, corner.y - at.y) - kLeftOut_m);
    at = corner;
  }
  return length > world.options.robot.speed_mps * to_seconds(duration);
}

// Planned is as much of the way as the robot can drive.
std::vector<Point2> planned_way(const World& world, const Point2& from, const std::vector<Point2>& points,
                                Duration duration) {
  check_reachable(world, from, points);
  std::vector<Point2> way;
  Point2 at = from;
  for (const Point2& next : points) {
    if (is_out_of_reach(world, from, way, duration)) break;
    const auto route = world.planner.route(at, next);
    way.insert(way.end(), route->begin(), route->end());
    at = next;
  }
  return way;
}

std::vector<Point2> straight_way(const World& world, const Point2& from, const std::vector<Point2>& points) {
  Point2 at = from;
  for (const Point2& next : points) {
    if (!world.planner.sees(at, next)) {
      throw ConfigurationError(
          kPointsKey,
          "the line from " + text_of(at) + " to " + text_of(next) + " leads through or too near to a wall",
          "move the points, or use mission: waypoints, which drives around walls");
    }
    at = next;
  }
  return points;
}

// Far more than a drive of any duration can reach are not needed: ten a minute.
std::vector<Point2> random_points(const World& world, const Pose2& start, Duration duration,
                                  std::uint64_t seed) {
  const auto& free = world.planner.free_points();
  const auto count = static_cast<std::size_t>(2.0 + to_seconds(duration) / 6.0);
  std::vector<Point2> points;
  Point2 at{start.x, start.y};
  for (std::uint64_t step = 0; points.size() < count && step < 20 * count; ++step) {
    const double u = simulation_random(seed, SimulationUse::kMission, step).uniform(0);
    const Point2& point =
        free[std::min(free.size() - 1, static_cast<std::size_t>(u * static_cast<double>(free.size())))];
    if (!world.planner.joins(at, point)) continue;
    points.push_back(point);
    at = point;
  }
  return points;
}

// Where the robot begins, by its options.
Pose2 beginning(const World& world, std::uint64_t seed) {
  const WorldRobotOptions& robot = world.options.robot;
  if (!robot.random_start) return world.start;
  const auto& free = world.planner.free_points();
  for (std::uint64_t step = 0; step < kMostStarts; ++step) {
    const RandomStream random = simulation_random(seed, SimulationUse::kStart, step);
    const double u = random.uniform(0) * static_cast<double>(free.size());
    const Point2& point = free[std::min(free.size() - 1, static_cast<std::size_t>(u))];
    if (world.planner.joins({world.start.x, world.start.y}, point))
      return {point.x, point.y, normalize_angle(kTwoPi * random.uniform(1))};
  }
  throw ConfigurationError("robot.random_start", "finds hardly a place that can be reached from robot.start",
                           "move robot.start into the part of the building that the robot is to drive in");
}

// Ends of the free stretches of lanes along x, there and back.
std::vector<Point2> coverage_points(const World& world) {
  const auto& free = world.planner.free_points();
  const double spacing = world.options.robot.spacing_m;
  std::vector<Point2> points;
  const double lowest = free.front().y;
  bool forward = true;
  for (double lane = lowest; lane <= free.back().y; lane += spacing) {
    std::vector<Point2> ends;
    for (const Point2& p : free) {
      if (std::abs(p.y - lane) > 0.51 * world.planner.resolution_m()) continue;
      const bool continues =
          !ends.empty() && p.x - ends.back().x < 1.5 * world.planner.resolution_m() && ends.size() % 2 == 0;
      if (continues) {
        ends.back() = p;
      } else {
        ends.insert(ends.end(), {p, p});
      }
    }
    if (!forward) std::reverse(ends.begin(), ends.end());
    forward = !forward;
    for (const Point2& p : ends) {
      if (world.planner.joins({world.start.x, world.start.y}, p)) points.push_back(p);
    }
  }
  return points;
}

std::vector<Point2> mission_points(const World& world, const Pose2& start, Duration duration,
                                   std::uint64_t seed) {
  const WorldRobotOptions& robot = world.options.robot;
  if (robot.mission == "random") return random_points(world, start, duration, seed);
  if (robot.mission == "coverage") return coverage_points(world);
  std::vector<Point2> points = parse_points(kPointsKey, robot.points);
  if (points.empty()) throw ConfigurationError(kPointsKey, "is empty", "write x,y separated by blanks");
  return points;
}

// Moves straight to each point and turns slowly all the while, as only omnidirectional wheels can.
Trajectory drive_sideways(const Pose2& start, const std::vector<Point2>& way, const DriveLimits& limits,
                          Duration duration) {
  const double dt = to_seconds(limits.step);
  Trajectory path{{Time{}, start}};
  double speed = 0.0;
  std::size_t next = 0;
  while (duration == Duration::zero() || path.back().stamp.time_since_epoch() < duration) {
    const auto [stamp, pose] = path.back();
    const double dx = way[next].x - pose.x, dy = way[next].y - pose.y;
    const double left = std::hypot(dx, dy);
    if (left < kReached_m) {
      next = (next + 1) % way.size();
      if (next == 0 && duration == Duration::zero()) break;
    }
    const double wanted = std::min(limits.speed_mps, std::sqrt(limits.acceleration_mps2 * left));
    speed += std::clamp(wanted - speed, -limits.acceleration_mps2 * dt, limits.acceleration_mps2 * dt);
    const double step = left > 0.0 ? std::min(left, speed * dt) / left : 0.0;
    path.push_back({stamp + limits.step,
                    {pose.x + step * dx, pose.y + step * dy,
                     normalize_angle(pose.theta + 0.25 * limits.turn_rate_radps * dt)}});
  }
  return path;
}

Trajectory drive(const World& world, const Pose2& start, const std::vector<Point2>& way, Duration duration) {
  DriveLimits limits;
  limits.speed_mps = world.options.robot.speed_mps;
  limits.turn_rate_radps = world.options.robot.turn_rate_radps;
  if (world.options.robot.drive == "omnidirectional") return drive_sideways(start, way, limits, duration);
  return drive_tour(start, way, limits, duration);
}

// A drive that lasts longer than one round goes back to `from` before it begins again.
std::vector<Point2> way_from(const World& world, const Point2& from, const std::vector<Point2>& points,
                             bool is_polyline, Duration duration) {
  std::vector<Point2> way =
      is_polyline ? straight_way(world, from, points) : planned_way(world, from, points, duration);
  if (duration == Duration::zero() || is_out_of_reach(world, from, way, duration)) return way;
  if (const auto back = world.planner.route(points.back(), from))
    way.insert(way.end(), back->begin(), back->end());
  return way;
}

// From where it was carried to, the robot drives the whole mission; what is left of the duration decides how
// far.
void kidnap(const World& world, const std::vector<Point2>& points, RobotDrive& driven) {
  const WorldRobotOptions& robot = world.options.robot;
  const Time at = Time{} + duration_from_seconds(robot.kidnap_at_s);
  if (robot.kidnap_at_s <= 0.0 || at >= driven.truth.back().stamp) return;
  const Pose2 to = parse_world_pose("robot.kidnap_to", robot.kidnap_to);
  check_free(world, {to.x, to.y}, "robot.kidnap_to");
  const Duration left = driven.truth.back().stamp - at;
  const auto is_later = [at](const StampedPose& p) { return p.stamp >= at; };
  const auto cut = std::find_if(driven.truth.begin(), driven.truth.end(), is_later);
  const Time first = cut->stamp;
  driven.truth.erase(cut, driven.truth.end());
  driven.kidnapped_to = driven.truth.size();
  const auto way = way_from(world, {to.x, to.y}, points, false, left);
  for (const StampedPose& p : drive(world, to, way, left)) {
    driven.truth.push_back({first + p.stamp.time_since_epoch(), p.pose});
  }
}

bool crosses(const Segment& way, const Segment& wall) {
  const auto side = [](const Segment& line, const Point2& p) {
    return (line.b.x - line.a.x) * (p.y - line.a.y) - (line.b.y - line.a.y) * (p.x - line.a.x);
  };
  return side(way, wall.a) * side(way, wall.b) < 0.0 && side(wall, way.a) * side(wall, way.b) < 0.0;
}

// A recorded drive may come near to walls, but goes through none.
void check_recorded(const World& world) {
  constexpr double kStep_m = 0.05;
  const Trajectory& path = world.path;
  Point2 at{path.front().pose.x, path.front().pose.y};
  for (const StampedPose& p : path) {
    const Point2 next{p.pose.x, p.pose.y};
    if (std::hypot(next.x - at.x, next.y - at.y) < kStep_m) continue;
    for (const Wall& wall : world.solid->walls()) {
      if (!crosses({at, next}, {wall.a, wall.b})) continue;
      throw ConfigurationError("robot.path", "leads through a wall at " + text_of(next),
                               "check that path and floor share a frame, or set robot.clear_m");
    }
    at = next;
  }
}

RobotDrive drive_recorded(const World& world) {
  check_recorded(world);
  RobotDrive driven{world.path, 0};
  if (world.options.robot.kidnap_at_s > 0.0) {
    throw ConfigurationError("robot.kidnap_at_s", "does not go with a recorded mission",
                             "choose another robot.mission");
  }
  return driven;
}

}  // namespace

RobotDrive drive_mission(const World& world, std::uint64_t seed) {
  const WorldRobotOptions& robot = world.options.robot;
  if (robot.random_start && robot.mission != "random")
    throw ConfigurationError("robot.random_start", "goes with a random mission only",
                             "set robot.mission: random");
  if (robot.mission == "recorded") return drive_recorded(world);
  Duration duration = duration_from_seconds(robot.duration_s);
  if (robot.mission == "random" && duration == Duration::zero()) duration = kRandomDrive;
  check_free(world, {world.start.x, world.start.y}, "robot.start");
  const Pose2 start = beginning(world, seed);
  const std::vector<Point2> points = mission_points(world, start, duration, seed);
  const std::vector<Point2> way =
      way_from(world, {start.x, start.y}, points, robot.mission == "polyline", duration);
  RobotDrive driven{drive(world, start, way, duration), 0};
  kidnap(world, points, driven);
  return driven;
}

}  // namespace cairn
