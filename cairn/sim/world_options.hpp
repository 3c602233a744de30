#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/sim/sensor_options.hpp"

#include <string>
#include <vector>

namespace cairn {

/// The world to simulate, as a file tells it. Points are texts, "x,y" in metres, lists of them separated by
/// blanks; poses "x,y,yaw". Everything is checked by make_world(), which names the key of what does not fit.

/// A wall along a line of points.
struct WorldWallOptions {
  std::string name;
  std::string points;
  bool closed = false;  ///< also from the last point to the first
  std::string material = "opaque";
  bool on_map = true;     ///< known to the localizer
  double height_m = 0.0;  ///< 0: up to the ceiling

  void visit(OptionVisitor& visitor);
};

/// Furniture, a pillar, the board of a shelf: an upright box. Sensors see it from outside, those above it or
/// below it only if they look up or down.
struct WorldBoxOptions {
  std::string name;
  std::string center = "0,0";
  double width_m = 1.0;  ///< along its x axis
  double depth_m = 1.0;
  double yaw_rad = 0.0;
  std::string material = "opaque";
  bool on_map = true;
  std::string was_at;     ///< where the map shows it, if it was moved since: "x,y"
  double bottom_m = 0.0;  ///< above the floor
  double height_m = 0.0;  ///< of its upper side above the floor; 0: up to the ceiling

  void visit(OptionVisitor& visitor);
};

/// A door leaf, there while the door is closed.
struct WorldDoorOptions {
  std::string name;
  std::string from = "0,0";
  std::string to = "1,0";
  double open_s = 20.0;
  double closed_s = 10.0;
  double phase_s = 0.0;  ///< by which the first opening is past at the start
  bool on_map = false;

  void visit(OptionVisitor& visitor);
};

struct WorldPeopleOptions {
  int walking = 0;   ///< go from place to place (social forces)
  int standing = 0;  ///< somewhere, beside the robot's way
  int crowd = 0;     ///< around the robot, going along with it
  double crowd_from_s = 0.0;
  double crowd_to_s = 1e9;
  double crowd_distance_m = 0.9;
  double radius_m = 0.22;
  double height_m = 1.75;
  double speed_mps = 1.1;

  void visit(OptionVisitor& visitor);
};

struct WorldOdometryOptions {
  double rate_hz = 25.0;
  double latency_s = 0.0;
  double wheel_base_m = 0.4;
  double distance_factor = 1.0;  ///< systematic: told = factor * true, as `cairn tune odometry` finds it
  double turn_factor = 1.0;
  double drift_rad_per_m = 0.0;       ///< turn told for each metre driven
  double sigma_wheel_radius = 0.003;  ///< systematic, relative, drawn once
  double sigma_wheel_base = 0.01;
  double sigma_per_sqrt_metre_m = 0.005;    ///< random, of the distance
  double sigma_per_sqrt_metre_rad = 0.004;  ///< random, of the heading
  double slip_every_m = 0.0;                ///< mean distance between slips; 0: none
  double slip_share = 0.5;                  ///< of the motion that a slip of half a second hides
  double bump_every_s = 0.0;                ///< mean time between bumps that the wheels do not see; 0: none
  double bump_m = 0.03;
  double bump_rad = 0.05;
  bool reversed = false;  ///< tells every motion with the wrong sign

  void visit(OptionVisitor& visitor);
};

struct WorldRobotOptions {
  std::string drive = "differential";  ///< or omnidirectional
  std::string start = "0,0,0";
  bool random_start = false;  ///< a random mission begins anywhere that can be reached from `start`
  std::string mission =
      "waypoints";       ///< waypoints (planned), polyline (as given), random, coverage, recorded
  std::string points;    ///< of waypoints and polyline
  std::string path;      ///< of a recorded mission: file with the poses that a real robot had
  std::string path_log;  ///< log whose scans number the poses of `path`, if that holds no stamps
  double clear_m =
      0.0;  ///< cells of a grid that are nearer to the recorded path are free: the robot was there
  double spacing_m = 2.0;   ///< between the lanes of a coverage drive
  double duration_s = 0.0;  ///< 0: once through the mission (random: 60 s)
  double radius_m = 0.3;    ///< no sensor sticks out, no wall comes nearer
  double speed_mps = 0.9;
  double turn_rate_radps = 1.2;
  double kidnap_at_s = 0.0;  ///< 0: never
  std::string kidnap_to;     ///< "x,y,yaw"
  WorldOdometryOptions odometry;

  void visit(OptionVisitor& visitor);
};

/// A planar laser, or (with a narrow field of view and a short range) a depth camera whose points are
/// flattened into a scan; depth_cameras give whole images.
struct WorldLaserOptions {
  std::string name;
  std::string mount = "0,0,0";  ///< T_base_sensor
  double height_m = 0.3;        ///< of its plane above the floor
  WorldTimingOptions timing;
  double field_of_view_rad = 4.71238898038469;
  int beams = 361;
  double range_min_m = 0.05;
  double range_max_m = 20.0;
  double sigma_range_m = 0.01;
  double sigma_per_m2 = 0.0;       ///< added: grows with the squared range, as a depth camera's
  double no_return_share = 0.005;  ///< of beams
  double short_share = 0.0;        ///< of beams that end early, anywhere on their way (dust, cables)
  double random_share = 0.0;       ///< of beams that tell any range
  double grazing_rad = 1.5;        ///< angle of incidence beyond which a wall returns nothing
  double sweep_s = 0.0;            ///< from the first beam to the last; the stamp is that of the first

  void visit(OptionVisitor& visitor);
};

struct WorldOptions {
  std::string built_in;  ///< cross, hall, corridor, warehouse, office; may be empty
  std::string file;      ///< floor from a file (vector text, GeoJSON, grid); may be empty
  std::string presets;   ///< files that are read before this one, separated by blanks; may be empty
  double map_resolution_m = 0.05;
  std::vector<WorldWallOptions> walls;
  std::vector<WorldBoxOptions> furniture;
  std::vector<WorldDoorOptions> doors;
  WorldPeopleOptions people;
  WorldRobotOptions robot;
  WorldCeilingOptions ceiling;
  WorldRadioOptions radio;
  std::vector<WorldTransmitterOptions> access_points;
  std::vector<WorldTransmitterOptions> beacons;
  std::vector<WorldLandmarkOptions> landmarks;
  std::vector<WorldLaserOptions> lasers;
  std::vector<WorldSonarOptions> sonars;
  std::vector<WorldDepthCameraOptions> depth_cameras;
  std::vector<WorldWifiOptions> wifi_radios;
  std::vector<WorldBeaconRadioOptions> beacon_radios;
  std::vector<WorldLandmarkDetectorOptions> landmark_detectors;
  std::vector<WorldCeilingCameraOptions> ceiling_cameras;
  std::vector<WorldGyroscopeOptions> gyroscopes;

  void visit(OptionVisitor& visitor);
};

/// "x,y". @throws ConfigurationError with where() = key
Point2 parse_point(const std::string& key, const std::string& text);
/// "x,y x,y ...".
std::vector<Point2> parse_points(const std::string& key, const std::string& text);
/// "x,y,yaw".
Pose2 parse_world_pose(const std::string& key, const std::string& text);

}  // namespace cairn
