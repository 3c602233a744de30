#include "cairn/sim/office_world.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace cairn {
namespace {

constexpr double kRaster_m = 0.05;
constexpr double kDoorMargin_m = 0.3;  // least wall between a door and the room's corner
constexpr double kInsideDoor_m = 0.7;  // how far behind the door the tour turns
constexpr double kStartX_m = 1.0;
constexpr int kAttempts = 40;  // at a free place for one box or person

double snap(double metres) { return std::round(metres / kRaster_m) * kRaster_m; }
double between_snapped(double low, double high, double u) { return snap(low + u * (high - low)); }

struct Room {
  Rectangle area;
  double door_x = 0.0;  // centre of the door
  bool north = true;
};

// Corridor-side and room-side face of the wall between the corridor and the room.
double corridor_face(const Room& room, const OfficeOptions& o) {
  return room.north ? o.corridor_width_m : 0.0;
}
double room_face(const Room& room) { return room.north ? room.area.min.y : room.area.max.y; }

std::vector<Room> make_side(bool north, const OfficeOptions& o, const RandomStream& random) {
  std::vector<Room> rooms;
  double x = 0.0;
  for (int i = 0; i < o.rooms_per_side; ++i) {
    const auto u = random.uniform4(static_cast<std::uint32_t>(i));
    const double width = between_snapped(o.min_room_width_m, o.max_room_width_m, u[0]);
    const double depth = between_snapped(o.min_room_depth_m, o.max_room_depth_m, u[1]);
    const double near = north ? snap(o.corridor_width_m + o.wall_thickness_m) : snap(-o.wall_thickness_m);
    const double far = snap(north ? near + depth : near - depth);
    const double reach = 0.5 * o.door_width_m + kDoorMargin_m;
    const double door_x = between_snapped(x + reach, x + width - reach, u[2]);
    rooms.push_back({{{x, std::min(near, far)}, {snap(x + width), std::max(near, far)}}, door_x, north});
    x = snap(x + width + o.wall_thickness_m);
  }
  return rooms;
}

std::vector<Room> make_rooms(const OfficeOptions& o, std::uint64_t seed) {
  std::vector<Room> rooms = make_side(true, o, simulation_random(seed, SimulationUse::kLayout, 0));
  const std::vector<Room> south = make_side(false, o, simulation_random(seed, SimulationUse::kLayout, 1));
  rooms.insert(rooms.end(), south.begin(), south.end());
  return rooms;
}

// Wall along y = const from x0 to x1, open where doors are (given from west to east).
void add_wall_with_doors(double y, double x0, double x1, const std::vector<double>& doors, double door_width,
                         std::vector<Segment>& walls) {
  for (const double door : doors) {
    walls.push_back({{x0, y}, {snap(door - 0.5 * door_width), y}});
    x0 = snap(door + 0.5 * door_width);
  }
  walls.push_back({{x0, y}, {x1, y}});
}

void add_room_walls(const Room& room, const OfficeOptions& o, std::vector<Segment>& walls) {
  const Rectangle& a = room.area;
  const double far = room.north ? a.max.y : a.min.y;
  walls.push_back({{a.min.x, a.min.y}, {a.min.x, a.max.y}});
  walls.push_back({{a.max.x, a.min.y}, {a.max.x, a.max.y}});
  walls.push_back({{a.min.x, far}, {a.max.x, far}});
  add_wall_with_doors(room_face(room), a.min.x, a.max.x, {room.door_x}, o.door_width_m, walls);
  for (const double side : {-0.5, 0.5}) {  // the door's jambs, through the thickness of the wall
    const double x = snap(room.door_x + side * o.door_width_m);
    walls.push_back({{x, corridor_face(room, o)}, {x, room_face(room)}});
  }
}

std::vector<Segment> make_walls(const std::vector<Room>& rooms, const OfficeOptions& o) {
  std::vector<Segment> walls;
  std::vector<double> north_doors;
  std::vector<double> south_doors;
  double length = 0.0;
  for (const Room& room : rooms) {
    add_room_walls(room, o, walls);
    (room.north ? north_doors : south_doors).push_back(room.door_x);
    length = std::max(length, room.area.max.x);
  }
  add_wall_with_doors(o.corridor_width_m, 0.0, length, north_doors, o.door_width_m, walls);
  add_wall_with_doors(0.0, 0.0, length, south_doors, o.door_width_m, walls);
  walls.push_back({{0.0, 0.0}, {0.0, o.corridor_width_m}});
  walls.push_back({{length, 0.0}, {length, o.corridor_width_m}});
  return walls;
}

// In through the door, to the middle, and out again.
void visit(const Room& room, const OfficeOptions& o, std::vector<Point2>& tour) {
  const double inwards = room.north ? 1.0 : -1.0;
  const Point2 before{room.door_x, 0.5 * o.corridor_width_m};
  const Point2 behind{room.door_x, room_face(room) + inwards * kInsideDoor_m};
  tour.insert(tour.end(), {before, behind, room.area.center(), behind, before});
}

// Northern rooms on the way east, southern rooms on the way back.
std::vector<Point2> make_tour(const std::vector<Room>& rooms, const OfficeOptions& o) {
  std::vector<Point2> tour;
  for (const Room& room : rooms) {
    if (room.north) visit(room, o, tour);
  }
  std::for_each(rooms.rbegin(), rooms.rend(), [&](const Room& room) {
    if (!room.north) visit(room, o, tour);
  });
  tour.push_back({kStartX_m, 0.5 * o.corridor_width_m});
  return tour;
}

/// Where nothing may stand: the line of the tour, and what stands already.
class Occupancy {
 public:
  Occupancy(const OfficeWorld& world, double clearance_m) : clearance_m_(clearance_m) {
    Point2 from{world.start.x, world.start.y};
    for (const Point2& to : world.tour) {
      tour_.push_back({from, to});
      from = to;
    }
  }

  /// Claims the disc (a box is claimed by the disc around it); false if it would be in the way.
  bool claim(const Point2& center, double radius_m) {
    const auto near_tour = [&](const Segment& s) { return distance(center, s) < clearance_m_ + radius_m; };
    const auto near_other = [&](const Cylinder& c) {
      return std::hypot(c.center.x - center.x, c.center.y - center.y) < c.radius_m + radius_m;
    };
    if (std::any_of(tour_.begin(), tour_.end(), near_tour)) return false;
    if (std::any_of(claimed_.begin(), claimed_.end(), near_other)) return false;
    claimed_.push_back({center, radius_m});
    return true;
  }

 private:
  double clearance_m_;
  std::vector<Segment> tour_;
  std::vector<Cylinder> claimed_;
};

// Draws up to kAttempts times; nullopt if no draw is free.
std::optional<Rectangle> place_box(const Rectangle& room, const RandomStream& random, std::uint32_t item,
                                   Occupancy& occupancy) {
  constexpr double kMinSide_m = 0.3;
  constexpr double kMaxSide_m = 1.4;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto u = random.uniform4(item, static_cast<std::uint16_t>(attempt));
    const double width = between_snapped(kMinSide_m, kMaxSide_m, u[0]);
    const double depth = snap(kMinSide_m + 0.5 * (kMaxSide_m - width));
    const double x = between_snapped(room.min.x, room.max.x - width, u[1]);
    const double y = between_snapped(room.min.y, room.max.y - depth, u[2]);
    const Rectangle box{{x, y}, {snap(x + width), snap(y + depth)}};
    if (occupancy.claim(box.center(), 0.5 * std::hypot(width, depth))) return box;
  }
  return std::nullopt;
}

void furnish(const OfficeOptions& o, std::uint64_t seed, Occupancy& occupancy, OfficeWorld& world) {
  const RandomStream random = simulation_random(seed, SimulationUse::kFurniture);
  std::uint32_t item = 0;
  for (const Rectangle& room : world.rooms) {
    for (int i = 0; i < o.furniture_per_room; ++i) {
      if (const auto box = place_box(room, random, item++, occupancy))
        add_outline(*box, world.building.walls);
    }
  }
}

// Every third room gets a person, round and round.
void place_people(const OfficeOptions& o, std::uint64_t seed, Occupancy& occupancy, OfficeWorld& world) {
  constexpr double kRadius_m = 0.2;
  const RandomStream random = simulation_random(seed, SimulationUse::kPeople);
  for (int i = 0; i < o.people; ++i) {
    const Rectangle& room = world.rooms[static_cast<std::size_t>(i) * 3 % world.rooms.size()];
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const auto u = random.uniform4(static_cast<std::uint32_t>(i), static_cast<std::uint16_t>(attempt));
      const Point2 center{std::lerp(room.min.x + kRadius_m, room.max.x - kRadius_m, u[0]),
                          std::lerp(room.min.y + kRadius_m, room.max.y - kRadius_m, u[1])};
      if (!occupancy.claim(center, kRadius_m)) continue;
      world.people.push_back({center, kRadius_m});
      break;
    }
  }
}

}  // namespace

void OfficeOptions::validate() const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw ConfigurationError("office", what, "change the sizes");
  };
  require(rooms_per_side >= 1 && rooms_per_side <= 100, "needs 1 to 100 rooms on each side");
  require(furniture_per_room >= 0 && furniture_per_room <= 100, "takes 0 to 100 pieces of furniture a room");
  require(people >= 0 && people <= 1000, "takes 0 to 1000 people");
  require(wall_thickness_m >= kRaster_m, "walls are at least 5 cm thick");
  require(clearance_m >= 0.0 && clearance_m <= 2.0, "clearance is 0 to 2 m");
  require(door_width_m >= 2.0 * clearance_m - kDoorMargin_m && door_width_m <= 3.0,
          "doors do not fit the clearance");
  require(corridor_width_m >= 1.5 && corridor_width_m <= 20.0, "the corridor is 1.5 to 20 m wide");
  require(min_room_width_m >= door_width_m + 2.0 * kDoorMargin_m, "a door does not fit the narrowest room");
  require(min_room_depth_m >= 2.0 * kInsideDoor_m, "rooms are at least 1.4 m deep");
  require(min_room_width_m <= max_room_width_m && max_room_width_m <= 100.0, "room widths are out of order");
  require(min_room_depth_m <= max_room_depth_m && max_room_depth_m <= 100.0, "room depths are out of order");
}

OfficeWorld make_office(const OfficeOptions& options, std::uint64_t seed) {
  options.validate();
  const std::vector<Room> rooms = make_rooms(options, seed);
  OfficeWorld world;
  world.building.walls = make_walls(rooms, options);
  for (const Room& room : rooms) world.rooms.push_back(room.area);
  world.start = {kStartX_m, 0.5 * options.corridor_width_m, 0.0};
  world.tour = make_tour(rooms, options);
  Occupancy occupancy(world, options.clearance_m);
  furnish(options, seed, occupancy, world);
  place_people(options, seed, occupancy, world);
  return world;
}

}  // namespace cairn
