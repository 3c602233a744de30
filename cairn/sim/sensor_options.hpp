#pragma once

#include "cairn/core/options.hpp"

#include <string>
#include <vector>

namespace cairn {

/// The simulated sensors other than lasers, as a world file tells them, and what they sense. Every sensor has
/// a `name`, a `mount` "x,y,yaw" (T_base_sensor) and a timing; make_world() checks what the ranges cannot.

/// When a sensor measures and when one hears of it.
struct WorldTimingOptions {
  double rate_hz = 10.0;
  double jitter_s = 0.0;          ///< standard deviation of the measuring time, at most 0.3 periods
  double latency_s = 0.0;         ///< from measuring to arrival
  double latency_jitter_s = 0.0;  ///< mean of what is added to it (exponential)
  double clock_offset_s = 0.0;    ///< of the sensor's clock: added to its stamps
  double lost_share = 0.0;        ///< of messages that never arrive
  double stall_every_s = 0.0;     ///< mean time between stalls; 0: none
  double stall_s = 1.0;           ///< what is measured in a stall arrives at its end
  double outage_every_s = 0.0;    ///< mean time between outages; 0: none
  double outage_s = 2.0;          ///< what is measured in an outage never arrives

  void visit(OptionVisitor& visitor);
};

/// A ring of sonar transducers that look outwards.
struct WorldSonarOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 5.0};
  int transducers = 16;      ///< the first looks along x, the others follow counter-clockwise
  double ring_m = 0.2;       ///< radius of the ring
  double height_m = 0.3;     ///< above the floor
  double cone_rad = 0.44;    ///< full opening angle
  double range_min_m = 0.1;  ///< nearest range told
  double range_max_m = 5.0;  ///< beyond: no echo
  /// Angle of incidence beyond which a smooth surface turns the sound away instead of sending it back
  /// (Leonard & Durrant-Whyte, "Directed Sonar Sensing", 1992); people return it from any angle.
  double critical_rad = 0.35;
  double sigma_range_m = 0.01;
  double sigma_share = 0.01;       ///< added: grows with the range
  double lost_echo_share = 0.02;   ///< of echoes
  double crosstalk_share = 0.005;  ///< of transducers that hear another's sound: any range

  void visit(OptionVisitor& visitor);
};

/// A camera of structured light: levelled, with the projector `baseline_m` to the right of the lens.
struct WorldDepthCameraOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 5.0};
  double height_m = 0.6;  ///< of the lens above the floor
  int width = 640;
  int height = 480;
  double field_of_view_rad = 1.0122;  ///< horizontal
  double range_min_m = 0.4;
  double range_max_m = 6.0;
  double baseline_m = 0.075;
  double disparity_step_px = 0.125;   ///< disparities are whole multiples of it
  double sigma_disparity_px = 0.045;  ///< noise of the disparity: that of the depth grows with its square
  double missing_share = 0.005;       ///< of pixels
  bool shadows = true;                ///< where the projector's light does not come, nothing is measured

  void visit(OptionVisitor& visitor);
};

struct WorldWifiOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 0.5};
  double device_offset_db = 0.0;   ///< added to all that this receiver tells
  double sigma_db = 2.0;           ///< noise of each level
  double sensitivity_dbm = -90.0;  ///< what is weaker is not heard
  double missed_share = 0.05;      ///< of access points that a scan does not find

  void visit(OptionVisitor& visitor);
};

/// A receiver of radio beacons that measures ranges, levels, or only who is heard.
struct WorldBeaconRadioOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 4.0};
  bool ranges = true;              ///< it measures ranges
  bool levels = true;              ///< it measures levels
  double height_m = 1.0;           ///< of the antenna above the floor
  double sigma_range_m = 0.05;     ///< noise of each range
  double bias_m = 0.0;             ///< added to each range
  double nlos_mean_m = 0.3;        ///< mean of what each wall between adds to a range (exponential)
  double range_max_m = 30.0;       ///< farther beacons are not heard
  double sigma_db = 2.0;           ///< noise of each level
  double sensitivity_dbm = -95.0;  ///< what is weaker is not heard
  double missed_share = 0.05;      ///< of beacons that a round does not find

  void visit(OptionVisitor& visitor);
};

/// A detector of landmarks (a camera with markers, a reflector finder).
struct WorldLandmarkDetectorOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 5.0};
  double field_of_view_rad = 2.0;
  double range_max_m = 8.0;
  double sigma_range_m = 0.02;
  double sigma_range_share = 0.02;  ///< added: grows with the range
  double sigma_bearing_rad = 0.01;
  double missed_share = 0.1;     ///< of landmarks in view
  double wrong_id_share = 0.0;   ///< of detections that name another landmark
  double false_per_scan = 0.05;  ///< mean number of detections where nothing is (Poisson)

  void visit(OptionVisitor& visitor);
};

/// A camera that looks straight up.
struct WorldCeilingCameraOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 5.0};
  int pixels = 32;               ///< along each side
  double side_m = 1.6;           ///< of the square that it sees on the ceiling
  double sigma_gray = 3.0;       ///< noise of each pixel
  double sigma_exposure = 0.05;  ///< relative brightness, drawn for each picture

  void visit(OptionVisitor& visitor);
};

/// A gyroscope about the vertical.
struct WorldGyroscopeOptions {
  std::string name;
  std::string mount = "0,0,0";
  WorldTimingOptions timing{.rate_hz = 50.0};
  double sigma_radps = 0.005;             ///< noise of each reading
  double sigma_bias_radps = 0.005;        ///< constant bias, drawn once
  double bias_walk_radps_per_sqrt_s = 0;  ///< random walk of the bias
  double sigma_scale = 0.002;             ///< relative error of the scale, drawn once

  void visit(OptionVisitor& visitor);
};

/// Where something hangs that radios or cameras find.
struct WorldTransmitterOptions {
  std::string name;
  std::string at = "0,0";    ///< x,y
  double power_dbm = -40.0;  ///< level at one metre
  // Of beacons alone:
  double height_m = 1.0;          ///< above the floor: ranges are slant
  double wrong_share = 0.0;       ///< of its ranges: anything shorter than the truth
  double obstructed_share = 0.0;  ///< of its ranges that are late, whatever the map shows between
  double obstructed_mean_m = 1;   ///< mean of what those are late (exponential)

  void visit(OptionVisitor& visitor);
};

struct WorldLandmarkOptions {
  std::string name;
  std::string at = "0,0";  ///< x,y
  int id = 0;

  void visit(OptionVisitor& visitor);
};

/// How levels of WiFi and beacons fall off: log-distance path loss, a loss for each wall on the line (Bahl &
/// Padmanabhan, "RADAR", 2000), and shadowing that is the same whenever one comes back to a place.
struct WorldRadioOptions {
  double path_loss_exponent = 2.2;
  double opaque_loss_db = 5.0;  ///< for each wall on the line
  double glass_loss_db = 2.0;
  double mesh_loss_db = 6.0;
  double mirror_loss_db = 8.0;
  double door_loss_db = 3.0;  ///< closed
  double person_loss_db = 3.0;
  double sigma_shadowing_db = 3.0;    ///< of the random field of each transmitter
  double shadowing_distance_m = 2.0;  ///< at which its correlation has fallen to 1/e
  int pattern = 1;                    ///< another number, other fields; the seed of a recording changes none

  void visit(OptionVisitor& visitor);
};

/// What hangs above: tiles, lamps and stains.
struct WorldCeilingOptions {
  double height_m = 2.8;
  double tile_m = 0.6;
  double lamp_share = 0.06;  ///< of tiles
  int pattern = 1;           ///< another number, another ceiling; the seed of a recording changes nothing

  void visit(OptionVisitor& visitor);
};

}  // namespace cairn
