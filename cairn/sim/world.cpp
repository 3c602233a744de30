#include "cairn/sim/world.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/wall_drawing.hpp"
#include "cairn/sim/sensor_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

// Walls of buildings lie on multiples of 5 cm: at cell centres, not on the border between cells.
constexpr double kPlanningResolution_m = 0.05;
// A cell's centre is up to half a diagonal nearer than what was drawn into it.
constexpr double kPlanningSlack_m = 0.04;

struct Walls {
  std::vector<Wall> solid;
  std::vector<HeightSpan> spans;  // of the solid ones
  std::vector<Wall> map;
  double ceiling_m;

  double top(double height_m) const { return height_m > 0.0 ? height_m : ceiling_m; }
};

void add(const Wall& wall, const HeightSpan& span, bool on_map, Walls& walls) {
  walls.solid.push_back(wall);
  walls.spans.push_back(span);
  if (on_map) walls.map.push_back(wall);
}

void add_wall(const WorldWallOptions& options, Walls& walls) {
  const std::string key = "walls." + options.name + ".points";
  std::vector<Point2> points = parse_points(key, options.points);
  if (points.size() < (options.closed ? 3U : 2U)) {
    throw ConfigurationError(
        key,
        options.closed ? "is an open polygon: it has fewer than three corners" : "has fewer than two points",
        "add points x,y, separated by blanks");
  }
  if (options.closed) points.push_back(points.front());
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i - 1] == points[i])
      throw ConfigurationError(key, "names a point twice in a row", "remove one");
    add({points[i - 1], points[i], material_named(options.material)}, {0.0, walls.top(options.height_m)},
        options.on_map, walls);
  }
}

std::array<Wall, 4> sides_of(const WorldBoxOptions& o, const Point2& center) {
  const Pose2 T_map_box{center.x, center.y, o.yaw_rad};
  const double x = 0.5 * o.width_m, y = 0.5 * o.depth_m;
  const Point2 corners[] = {T_map_box * Point2{-x, -y}, T_map_box * Point2{x, -y}, T_map_box * Point2{x, y},
                            T_map_box * Point2{-x, y}};
  const Material material = material_named(o.material);
  std::array<Wall, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) sides[i] = {corners[i], corners[(i + 1) % 4], material};
  return sides;
}

void add_furniture(const WorldBoxOptions& o, std::int32_t box, Walls& walls) {
  const std::string key = "furniture." + o.name;
  const Point2 center = parse_point(key + ".center", o.center);
  const double top_m = walls.top(o.height_m);
  if (top_m <= o.bottom_m)
    throw ConfigurationError(key + ".bottom_m", "is not below its upper side", "correct it or height_m");
  for (const Wall& side : sides_of(o, center))
    add(side, {o.bottom_m, top_m, box}, o.on_map && o.was_at.empty(), walls);
  if (o.was_at.empty() || !o.on_map) return;
  for (const Wall& side : sides_of(o, parse_point(key + ".was_at", o.was_at))) walls.map.push_back(side);
}

WorldDoor make_door(const WorldDoorOptions& o, Walls& walls) {
  const std::string key = "doors." + o.name;
  const Wall leaf{parse_point(key + ".from", o.from), parse_point(key + ".to", o.to), Material::kOpaque};
  if (leaf.a == leaf.b)
    throw ConfigurationError(key + ".to", "is where the door begins", "give the leaf a width");
  if (o.on_map) walls.map.push_back(leaf);
  return {leaf, o.open_s, o.closed_s, o.phase_s};
}

double distance_to(const Point2& point, const std::vector<Wall>& walls) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) nearest = std::min(nearest, distance(point, wall));
  return nearest;
}

void check_start(const WorldRobotOptions& robot, const Pose2& start, const std::vector<Wall>& solid) {
  const Bounds2 bounds = VectorMap(solid).bounds();
  const bool outside =
      start.x < bounds.min.x || start.x > bounds.max.x || start.y < bounds.min.y || start.y > bounds.max.y;
  if (outside) throw ConfigurationError("robot.start", "lies outside of all walls", "move it inside");
  const double nearest = distance_to({start.x, start.y}, solid);
  if (nearest >= robot.radius_m) return;
  throw ConfigurationError(
      "robot.start", "lies " + std::to_string(nearest).substr(0, 4) + " m from a wall, in or beside it",
      "move it at least robot.radius_m (" + std::to_string(robot.radius_m).substr(0, 4) + ") away");
}

void check_crowd(const WorldPeopleOptions& people, const WorldRobotOptions& robot) {
  const double touching_m = people.radius_m + robot.radius_m;
  if (people.crowd == 0 || people.crowd_distance_m >= touching_m) return;
  throw ConfigurationError(
      "people.crowd_distance_m", "puts the crowd into the robot",
      "make it at least robot.radius_m + people.radius_m (" + std::to_string(touching_m).substr(0, 4) + ")");
}

constexpr std::size_t kMostRecordedPoses = 1'800'000;  // ten hours

// References jitter, by their own noise and by stamps that run backwards: a robot would not drive that. Each
// pose is the mean of those within half a second, fewer at the ends.
Trajectory smoothed(const Trajectory& path) {
  constexpr std::size_t kHalf = 25;
  std::vector<double> x{0.0}, y{0.0}, heading{0.0};  // sums
  double turned = path.front().pose.theta;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) turned += angle_difference(path[i].pose.theta, path[i - 1].pose.theta);
    x.push_back(x.back() + path[i].pose.x);
    y.push_back(y.back() + path[i].pose.y);
    heading.push_back(heading.back() + turned);
  }
  Trajectory smooth;
  smooth.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t half = std::min({kHalf, i, path.size() - 1 - i});
    const std::size_t first = i - half, end = i + half + 1;
    const double n = static_cast<double>(end - first);
    smooth.push_back({path[i].stamp,
                      {(x[end] - x[first]) / n, (y[end] - y[first]) / n,
                       normalize_angle((heading[end] - heading[first]) / n)}});
  }
  return smooth;
}

// The drive that a recorded mission repeats: stamps from zero, 50 poses a second.
Trajectory recorded_path(const WorldRobotOptions& robot, const Trajectory& recorded) {
  if (robot.mission != "recorded") return {};
  if (recorded.size() < 2) {
    throw ConfigurationError("robot.path", "holds fewer than two poses, or is missing",
                             "name a trajectory, or choose another robot.mission");
  }
  const Duration step = std::chrono::milliseconds(20);
  const Time first = recorded.front().stamp;
  Duration length = recorded.back().stamp - first;
  if (robot.duration_s > 0.0) length = std::min(length, duration_from_seconds(robot.duration_s));
  if (static_cast<std::size_t>(length / step) > kMostRecordedPoses)
    throw ConfigurationError("robot.path", "lasts longer than ten hours", "set robot.duration_s");
  Trajectory path;
  auto after = recorded.begin() + 1;
  for (Duration t{}; t <= length; t += step) {
    while (after->stamp < first + t) ++after;
    const Trajectory pair{*(after - 1), *after};
    path.push_back({Time{} + t, *pose_at(pair, first + t)});
  }
  return smoothed(path);
}

// Free cells at the edge of the drawing are outside: the walls have let the flood through.
void check_enclosed(const OccupancyGrid& grid) {
  const GridGeometry& g = grid.geometry();
  const auto free = [&](int column, int row) { return grid.state(g.index(column, row)) == CellState::kFree; };
  bool open = false;
  for (int column = 0; column < g.width; ++column)
    open = open || free(column, 0) || free(column, g.height - 1);
  for (int row = 0; row < g.height; ++row) open = open || free(0, row) || free(g.width - 1, row);
  if (open)
    throw ConfigurationError("walls", "do not enclose robot.start: there is a way out", "close the outline");
}

OccupancyGrid draw(std::vector<Wall> walls, double resolution_m, const Pose2& start) {
  return draw_walls(VectorMap(std::move(walls)),
                    {.resolution_m = resolution_m, .seen = kAllMaterials, .inside = {{start.x, start.y}}});
}

}  // namespace

bool WorldDoor::is_closed(double time_s) const {
  const double period = open_s + closed_s;
  return std::fmod(time_s + phase_s, period) >= open_s;
}

World make_world(const WorldOptions& options, std::span<const Wall> floor, const Trajectory& recorded) {
  const double ceiling_m = options.ceiling.height_m;
  Walls walls{{floor.begin(), floor.end()},
              std::vector<HeightSpan>(floor.size(), {0.0, ceiling_m}),
              {floor.begin(), floor.end()},
              ceiling_m};
  for (const WorldWallOptions& wall : options.walls) add_wall(wall, walls);
  for (std::size_t i = 0; i < options.furniture.size(); ++i)
    add_furniture(options.furniture[i], static_cast<std::int32_t>(i), walls);
  std::vector<WorldDoor> doors;
  for (const WorldDoorOptions& door : options.doors) doors.push_back(make_door(door, walls));
  if (walls.solid.empty() || walls.map.empty()) {
    throw ConfigurationError("walls", "is empty, or none is on the map",
                             "name walls, a built_in world, or a file");
  }
  check_sensors(options);
  Trajectory path = recorded_path(options.robot, recorded);
  const Pose2 start = path.empty() ? parse_world_pose("robot.start", options.robot.start) : path.front().pose;
  check_crowd(options.people, options.robot);
  if (path.empty()) check_start(options.robot, start, walls.solid);
  const OccupancyGrid planning = draw(walls.solid, kPlanningResolution_m, start);
  if (path.empty()) check_enclosed(planning);  // maps of real floors have ragged edges
  OccupancyGrid map = draw(walls.map, options.map_resolution_m, start);
  return {options,
          std::make_shared<const VectorMap>(std::move(walls.solid)),
          std::move(walls.spans),
          std::move(map),
          RoutePlanner(planning, options.robot.radius_m + kPlanningSlack_m),
          std::move(doors),
          start,
          std::move(path)};
}

}  // namespace cairn
