#include "cairn/core/errors.hpp"
#include "cairn/sim/office_world.hpp"
#include "cairn/sim/world.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string text_of(const Point2& p) { return text_of(p.x) + "," + text_of(p.y); }

std::string text_of(const std::vector<Point2>& points) {
  std::string text;
  for (const Point2& p : points) text += (text.empty() ? "" : " ") + text_of(p);
  return text;
}

void add_wall(WorldOptions& world, const std::string& name, const std::vector<Point2>& points,
              bool closed = false) {
  world.walls.push_back({name, text_of(points), closed, "opaque", true});
}

WorldLaserOptions usual_laser() {
  WorldLaserOptions laser;
  laser.name = "laser";
  laser.mount = "0.2,0,0";
  return laser;
}

WorldOptions make_office_options(std::uint64_t seed) {
  const OfficeWorld office = make_office({}, seed);
  WorldOptions world;
  for (const Segment& wall : office.building.walls) {
    add_wall(world, "wall" + std::to_string(world.walls.size()), {wall.a, wall.b});
  }
  world.robot.start = text_of({office.start.x, office.start.y}) + "," + text_of(office.start.theta);
  world.robot.mission = "polyline";
  world.robot.points = text_of(office.tour);
  world.people.standing = static_cast<int>(office.people.size());
  return world;
}

// Four arms of equal length: every quarter turn about the centre maps the floor to itself.
WorldOptions make_cross() {
  constexpr double kArm_m = 7.5, kHalf_m = 1.0;
  std::vector<Point2> outline;
  Pose2 T_quarter;
  for (int quarter = 0; quarter < 4; ++quarter) {
    outline.push_back(T_quarter * Point2{kArm_m, -kHalf_m});
    outline.push_back(T_quarter * Point2{kArm_m, kHalf_m});
    outline.push_back(T_quarter * Point2{kHalf_m, kHalf_m});
    T_quarter = T_quarter * Pose2{0.0, 0.0, 0.5 * std::numbers::pi};
  }
  // Rounding of the turns would open the corners.
  for (Point2& p : outline) p = {std::round(2.0 * p.x) / 2.0, std::round(2.0 * p.y) / 2.0};
  WorldOptions world;
  add_wall(world, "outline", outline, true);
  world.robot.start = "-6.5,0,0";
  world.robot.points = "6.5,0 0,6.5 0,-6.5 -6.5,0";
  return world;
}

// One side of the hall and its ten offices, as if it were the eastern one: partitions, and the inner wall
// with doors.
void add_hall_side(WorldOptions& world, int side) {
  constexpr double kHalf_m = 30.0, kRoom_m = 6.0, kDepth_m = 5.0, kDoor_m = 1.0;
  const Pose2 T_side{0.0, 0.0, 0.5 * std::numbers::pi * side};
  const std::string prefix = "side" + std::to_string(side) + "_";
  const auto point = [&](double x, double y) {
    const Point2 p = T_side * Point2{x, y};
    return Point2{std::round(20.0 * p.x) / 20.0, std::round(20.0 * p.y) / 20.0};
  };
  for (int room = 0; room < 10; ++room) {
    const double low = -kHalf_m + kRoom_m * room;
    const double door = low + 0.5 * (kRoom_m - kDoor_m);
    const std::string name = prefix + std::to_string(room);
    add_wall(world, name + "a", {point(kHalf_m, low), point(kHalf_m, door)});
    add_wall(world, name + "b", {point(kHalf_m, door + kDoor_m), point(kHalf_m, low + kRoom_m)});
    add_wall(world, name + "p", {point(kHalf_m, low), point(kHalf_m + kDepth_m, low)});
  }
  add_wall(world, prefix + "end", {point(kHalf_m, kHalf_m), point(kHalf_m + kDepth_m, kHalf_m)});
}

WorldOptions make_hall() {
  WorldOptions world;
  add_wall(world, "outline", {{-35.0, -35.0}, {35.0, -35.0}, {35.0, 35.0}, {-35.0, 35.0}}, true);
  for (int side = 0; side < 4; ++side) add_hall_side(world, side);
  world.robot.start = "-32.5,3,0";
  world.robot.points = "-20,3 0,0 12,8 -20,3 -32.5,3";
  return world;
}

// A niche of the same size every five metres, on both sides.
WorldOptions make_corridor() {
  constexpr double kLength_m = 100.0, kHalf_m = 1.2, kNiche_m = 0.2;
  std::vector<Point2> north, south;
  for (double x = 0.0; x < kLength_m; x += 5.0) {
    north.insert(north.end(), {{x, kHalf_m},
                               {x + 2.0, kHalf_m},
                               {x + 2.0, kHalf_m + kNiche_m},
                               {x + 3.0, kHalf_m + kNiche_m},
                               {x + 3.0, kHalf_m}});
  }
  for (const Point2& p : north) south.push_back({p.x, -p.y});
  std::vector<Point2> outline = south;
  outline.push_back({kLength_m, -kHalf_m});
  outline.push_back({kLength_m, kHalf_m});
  outline.insert(outline.end(), north.rbegin(), north.rend());
  WorldOptions world;
  add_wall(world, "outline", outline, true);
  world.robot.start = "2,0,0";
  world.robot.points = "97,0 2,0";
  return world;
}

WorldOptions make_warehouse() {
  WorldOptions world;
  add_wall(world, "outline", {{0.0, 0.0}, {40.0, 0.0}, {40.0, 24.0}, {0.0, 24.0}}, true);
  for (int row = 0; row < 5; ++row) {
    for (int half = 0; half < 2; ++half) {
      const Point2 center{half == 0 ? 11.0 : 29.0, 4.0 + 4.0 * row};
      world.furniture.push_back(
          {"shelf" + std::to_string(2 * row + half), text_of(center), 14.0, 1.2, 0.0, "opaque", true, ""});
    }
  }
  for (int pillar = 0; pillar < 3; ++pillar) {
    const Point2 center{20.0, 6.0 + 6.0 * pillar};
    world.furniture.push_back(
        {"pillar" + std::to_string(pillar), text_of(center), 0.4, 0.4, 0.0, "opaque", true, ""});
  }
  world.robot.start = "2,2,0";
  world.robot.points = "38,2 38,6 2,6 2,10 38,10 38,14 2,14 2,22 20,22 2,2";
  return world;
}

WorldOptions make_options(const std::string& name, std::uint64_t seed) {
  if (name == "office") return make_office_options(seed);
  if (name == "cross") return make_cross();
  if (name == "hall") return make_hall();
  if (name == "corridor") return make_corridor();
  if (name == "warehouse") return make_warehouse();
  throw ConfigurationError("built_in", "there is no world '" + name + "'",
                           "give office, cross, hall, corridor or warehouse");
}

}  // namespace

WorldOptions built_in_world(const std::string& name, std::uint64_t seed) {
  if (name.empty()) return {};
  WorldOptions world = make_options(name, seed);
  world.built_in = name;
  world.lasers.push_back(usual_laser());
  return world;
}

}  // namespace cairn
