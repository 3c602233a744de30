#include "cairn/sim/world_options.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/sim/option_tables.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

namespace cairn {
namespace {

constexpr double kFar_m = 1e5;
constexpr Range kSize{1e-3, 1e4};
constexpr Range kHeight{0.0, 1000.0};
constexpr Range kShare{0.0, 1.0};
constexpr Range kSeconds{0.0, 1e9};
constexpr Range kRate{0.01, 1000.0};
constexpr Range kNoise{0.0, 10.0};
const std::vector<std::string> kMaterials{"opaque", "glass", "mesh", "mirror"};

std::vector<double> parse_numbers(const std::string& key, const std::string& text, std::size_t count,
                                  const char* form) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (numbers.size() < count) {
    double value = 0.0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc() || !(std::abs(value) <= kFar_m)) break;
    numbers.push_back(value);
    at = read.ptr;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (numbers.size() != count || at != end) {
    throw ConfigurationError(key, "holds '" + text.substr(0, 40) + "'",
                             std::string("write ") + form + " (m, rad)");
  }
  return numbers;
}

}  // namespace

Point2 parse_point(const std::string& key, const std::string& text) {
  const std::vector<double> n = parse_numbers(key, text, 2, "x,y");
  return {n[0], n[1]};
}

std::vector<Point2> parse_points(const std::string& key, const std::string& text) {
  std::istringstream stream(text);
  std::vector<Point2> points;
  for (std::string word; stream >> word;) points.push_back(parse_point(key, word));
  return points;
}

Pose2 parse_world_pose(const std::string& key, const std::string& text) {
  const std::vector<double> n = parse_numbers(key, text, 3, "x,y,yaw");
  return {n[0], n[1], normalize_angle(n[2])};
}

void WorldWallOptions::visit(OptionVisitor& v) {
  v.text({"points", "Corners x,y separated by blanks"}, points);
  v.flag({"closed", "Also a wall from the last corner to the first"}, closed);
  v.choice(
      {"material", "glass returns near-normal beams only, mesh every other, a mirror shows another place"},
      material, kMaterials);
  v.flag({"on_map", "Known to the localizer"}, on_map);
  v.number({"height_m", "0: up to the ceiling"}, height_m, kHeight);
}

void WorldBoxOptions::visit(OptionVisitor& v) {
  v.text({"center", "x,y"}, center);
  v.number({"width_m", "Along its x axis"}, width_m, kSize);
  v.number({"depth_m", "Along its y axis"}, depth_m, kSize);
  v.number({"yaw_rad", "Turn about its centre"}, yaw_rad, {-kTwoPi, kTwoPi});
  v.choice({"material", "As of walls"}, material, kMaterials);
  v.flag({"on_map", "Known to the localizer"}, on_map);
  v.text({"was_at", "Centre x,y where the map shows it, if it was moved since"}, was_at);
  v.number({"bottom_m", "Of its lower side above the floor"}, bottom_m, kHeight);
  v.number({"height_m", "Of its upper side above the floor; 0: up to the ceiling"}, height_m, kHeight);
}

void WorldDoorOptions::visit(OptionVisitor& v) {
  v.text({"from", "One end x,y of the leaf"}, from);
  v.text({"to", "The other"}, to);
  v.number({"open_s", "Time that it stays open"}, open_s, {0.1, 1e9});
  v.number({"closed_s", "Time that it stays closed"}, closed_s, kSeconds);
  v.number({"phase_s", "How long it is open already at the start"}, phase_s, kSeconds);
  v.flag({"on_map", "The map shows it closed"}, on_map);
}

void WorldPeopleOptions::visit(OptionVisitor& v) {
  v.integer({"walking", "People who go from place to place"}, walking, {0.0, 1000.0});
  v.integer({"standing", "People who stand beside the robot's way"}, standing, {0.0, 1000.0});
  v.integer({"crowd", "People around the robot who go along with it"}, crowd, {0.0, 50.0});
  v.number({"crowd_from_s", "When they come"}, crowd_from_s, kSeconds);
  v.number({"crowd_to_s", "When they leave"}, crowd_to_s, kSeconds);
  v.number({"crowd_distance_m", "Their distance from the robot's centre"}, crowd_distance_m, {0.3, 10.0});
  v.number({"radius_m", "Of a person"}, radius_m, {0.01, 2.0});
  v.number({"height_m", "Of a person"}, height_m, {0.1, 3.0});
  v.number({"speed_mps", "Mean speed of walking"}, speed_mps, {0.05, 5.0});
}

void WorldOdometryOptions::visit(OptionVisitor& v) {
  v.number({"rate_hz", "Messages per second"}, rate_hz, kRate);
  v.number({"latency_s", "From measuring to arrival"}, latency_s, {0.0, 10.0});
  v.number({"wheel_base_m", "Distance of the wheels"}, wheel_base_m, {0.01, 10.0});
  v.number({"distance_factor", "Systematic: told = factor * true"}, distance_factor, {0.5, 2.0});
  v.number({"turn_factor", "Likewise of turns"}, turn_factor, {0.5, 2.0});
  v.number({"drift_rad_per_m", "Turn told for each metre driven"}, drift_rad_per_m, {-1.0, 1.0});
  v.number({"sigma_wheel_radius", "Systematic relative error of each wheel, drawn once"}, sigma_wheel_radius,
           {0.0, 0.5});
  v.number({"sigma_wheel_base", "Systematic relative error of the base, drawn once"}, sigma_wheel_base,
           {0.0, 0.5});
  v.number({"sigma_per_sqrt_metre_m", "Random error of the distance after one metre"}, sigma_per_sqrt_metre_m,
           kNoise);
  v.number({"sigma_per_sqrt_metre_rad", "Random error of the heading after one metre"},
           sigma_per_sqrt_metre_rad, kNoise);
  v.number({"slip_every_m", "Mean distance between slips of half a second; 0: none"}, slip_every_m,
           {0.0, 1e6});
  v.number({"slip_share", "Share of the wheels' turn that moves nothing in a slip"}, slip_share, kShare);
  v.number({"bump_every_s", "Mean time between pushes that the wheels do not see; 0: none"}, bump_every_s,
           kSeconds);
  v.number({"bump_m", "Standard deviation of a push"}, bump_m, kNoise);
  v.number({"bump_rad", "Standard deviation of its turn"}, bump_rad, kNoise);
  v.flag({"reversed", "Every motion has the wrong sign"}, reversed);
}

void WorldRobotOptions::visit(OptionVisitor& v) {
  v.choice({"drive", "differential turns on the spot; omnidirectional also moves sideways"}, drive,
           {"differential", "omnidirectional"});
  v.text({"start", "x,y,yaw"}, start);
  v.flag(
      {"random_start", "A random mission begins anywhere that can be reached from `start`, looking anywhere"},
      random_start);
  v.choice(
      {"mission",
       "waypoints: planned around walls; polyline: straight through the points; random; coverage; recorded: "
       "as `path` tells"},
      mission, {"waypoints", "polyline", "random", "coverage", "recorded"});
  v.text({"path", "recorded: file with the poses that a real robot had, relative to this file's folder"},
         path);
  v.text({"path_log", "recorded: the log whose scans number the poses of a path without stamps"}, path_log);
  v.number({"clear_m", "recorded: cells of the floor's grid nearer to the path than this are free"}, clear_m,
           {0.0, 5.0});
  v.text({"points", "x,y separated by blanks"}, points);
  v.number({"spacing_m", "Between the lanes of a coverage drive"}, spacing_m, {0.1, 1000.0});
  v.number({"duration_s", "0: once through the mission (random: 60 s)"}, duration_s, {0.0, 36000.0});
  v.number({"radius_m", "No sensor sticks out of it, no wall comes nearer"}, radius_m, {0.01, 10.0});
  v.number({"speed_mps", "Largest speed"}, speed_mps, {0.01, 20.0});
  v.number({"turn_rate_radps", "Largest turn rate"}, turn_rate_radps, {0.01, 20.0});
  v.number({"kidnap_at_s", "When the robot is carried away; 0: never"}, kidnap_at_s, kSeconds);
  v.text({"kidnap_to", "Where to: x,y,yaw"}, kidnap_to);
  v.section({"odometry", "What the wheels tell"}, [this](OptionVisitor& inner) { odometry.visit(inner); });
}

void WorldLaserOptions::visit(OptionVisitor& v) {
  v.text({"mount", "Pose x,y,yaw on the robot's base"}, mount);
  v.number({"height_m", "Of its plane above the floor"}, height_m, kHeight);
  timing.visit(v);
  v.number({"field_of_view_rad", "Symmetric about its x axis"}, field_of_view_rad, {0.01, kTwoPi});
  v.integer({"beams", "The first and the last lie on the edges"}, beams, {2.0, 100'000.0});
  v.number({"range_min_m", "Nearest range told"}, range_min_m, {0.0, 100.0});
  v.number({"range_max_m", "Beyond: no return"}, range_max_m, {0.1, 1000.0});
  v.number({"sigma_range_m", "Noise of each range"}, sigma_range_m, kNoise);
  v.number({"sigma_per_m2", "Noise that grows with the squared range"}, sigma_per_m2, kNoise);
  v.number({"no_return_share", "Share of beams without return"}, no_return_share, kShare);
  v.number({"short_share", "Share of beams that end anywhere on their way"}, short_share, kShare);
  v.number({"random_share", "Share of beams that tell any range"}, random_share, kShare);
  v.number({"grazing_rad", "Angle of incidence beyond which a wall returns nothing"}, grazing_rad,
           {0.0, 0.5 * kPi});
  v.number({"sweep_s", "From the first beam to the last"}, sweep_s, {0.0, 1.0});
}

void WorldOptions::visit(OptionVisitor& v) {
  v.choice({"built_in", "Floor, furniture and mission to begin with"}, built_in,
           {"", "office", "cross", "hall", "corridor", "warehouse"});
  v.text({"file", "Floor from a file: x1,y1,x2,y2 text, GeoJSON, grid; relative to this file's folder"},
         file);
  v.text(
      {"presets", "Files of sensors and robots that are read before this one, separated by blanks; relative"},
      presets);
  v.number({"map_resolution_m", "Of the map that goes with the log"}, map_resolution_m, {0.01, 1.0});
  visit_table(v, {"walls", "By name"}, walls);
  visit_table(v, {"furniture", "Boxes, by name"}, furniture);
  visit_table(v, {"doors", "By name"}, doors);
  v.section({"people", "Not on the map"}, [this](OptionVisitor& inner) { people.visit(inner); });
  v.section({"robot", "How it drives"}, [this](OptionVisitor& inner) { robot.visit(inner); });
  v.section({"ceiling", "What hangs above"}, [this](OptionVisitor& inner) { ceiling.visit(inner); });
  v.section({"radio", "How levels fall off"}, [this](OptionVisitor& inner) { radio.visit(inner); });
  visit_table(v, {"access_points", "Of WiFi, by name (their id)"}, access_points);
  visit_table(v, {"beacons", "By name (their id)"}, beacons);
  visit_table(v, {"landmarks", "By name"}, landmarks);
  visit_table(v, {"lasers", "By name, in the order of the log's streams"}, lasers);
  visit_table(v, {"sonars", "Rings, by name"}, sonars);
  visit_table(v, {"depth_cameras", "By name"}, depth_cameras);
  visit_table(v, {"wifi_radios", "By name"}, wifi_radios);
  visit_table(v, {"beacon_radios", "By name"}, beacon_radios);
  visit_table(v, {"landmark_detectors", "By name"}, landmark_detectors);
  visit_table(v, {"ceiling_cameras", "By name"}, ceiling_cameras);
  visit_table(v, {"gyroscopes", "By name"}, gyroscopes);
}

}  // namespace cairn
