#include "cairn/sim/sensor_options.hpp"

#include "cairn/core/angle.hpp"

namespace cairn {
namespace {

constexpr Range kRate{0.01, 1000.0};
constexpr Range kShare{0.0, 1.0};
constexpr Range kSeconds{0.0, 1e9};
constexpr Range kNoise{0.0, 10.0};
constexpr Range kDecibel{0.0, 100.0};
constexpr Range kLevel{-200.0, 50.0};
constexpr Range kRange{0.0, 1000.0};

void visit_mount(OptionVisitor& v, std::string& mount, WorldTimingOptions& timing) {
  v.text({"mount", "Pose x,y,yaw on the robot's base"}, mount);
  timing.visit(v);
}

}  // namespace

void WorldTimingOptions::visit(OptionVisitor& v) {
  v.number({"rate_hz", "Measurements per second"}, rate_hz, kRate);
  v.number({"jitter_s", "Standard deviation of the measuring time"}, jitter_s, {0.0, 10.0});
  v.number({"latency_s", "From measuring to arrival"}, latency_s, {0.0, 10.0});
  v.number({"latency_jitter_s", "Mean of what is added to the latency (exponential)"}, latency_jitter_s,
           {0.0, 10.0});
  v.number({"clock_offset_s", "Added to its stamps"}, clock_offset_s, {-10.0, 10.0});
  v.number({"lost_share", "Share of messages that never arrive"}, lost_share, kShare);
  v.number({"stall_every_s", "Mean time between stalls; 0: none"}, stall_every_s, kSeconds);
  v.number({"stall_s", "What is measured in a stall arrives at its end"}, stall_s, {0.0, 9.0});
  v.number({"outage_every_s", "Mean time between outages; 0: none"}, outage_every_s, kSeconds);
  v.number({"outage_s", "What is measured in an outage never arrives"}, outage_s, kSeconds);
}

void WorldSonarOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.integer({"transducers", "The first looks along x, the others follow counter-clockwise"}, transducers,
            {1.0, 256.0});
  v.number({"ring_m", "Radius of the ring"}, ring_m, {0.0, 10.0});
  v.number({"height_m", "Above the floor"}, height_m, {0.0, 100.0});
  v.number({"cone_rad", "Full opening angle"}, cone_rad, {0.01, kPi});
  v.number({"range_min_m", "Nearest range told"}, range_min_m, kRange);
  v.number({"range_max_m", "Beyond: no echo"}, range_max_m, {0.1, 100.0});
  v.number({"critical_rad", "Angle of incidence beyond which a surface sends no sound back"}, critical_rad,
           {0.0, 0.5 * kPi});
  v.number({"sigma_range_m", "Noise of each range"}, sigma_range_m, kNoise);
  v.number({"sigma_share", "Noise that grows with the range"}, sigma_share, kShare);
  v.number({"lost_echo_share", "Share of echoes that are not heard"}, lost_echo_share, kShare);
  v.number({"crosstalk_share", "Share of transducers that hear another's sound: any range"}, crosstalk_share,
           kShare);
}

void WorldDepthCameraOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.number({"height_m", "Of the lens above the floor"}, height_m, {0.01, 100.0});
  v.integer({"width", "Columns"}, width, {2.0, 4096.0});
  v.integer({"height", "Rows"}, height, {1.0, 4096.0});
  v.number({"field_of_view_rad", "Horizontal"}, field_of_view_rad, {0.05, 2.5});
  v.number({"range_min_m", "Nearest depth told"}, range_min_m, {0.01, 60.0});
  v.number({"range_max_m", "Farthest depth told"}, range_max_m, {0.1, 65.0});
  v.number({"baseline_m", "From the lens to the projector"}, baseline_m, {0.005, 1.0});
  v.number({"disparity_step_px", "Disparities are whole multiples of it"}, disparity_step_px, {1e-3, 4.0});
  v.number({"sigma_disparity_px", "Noise; that of the depth grows with its square"}, sigma_disparity_px,
           kNoise);
  v.number({"missing_share", "Share of pixels without reading"}, missing_share, kShare);
  v.flag({"shadows", "Nothing is measured where the projector's light does not come"}, shadows);
}

void WorldWifiOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.number({"device_offset_db", "Added to all that this receiver tells"}, device_offset_db, {-50.0, 50.0});
  v.number({"sigma_db", "Noise of each level"}, sigma_db, kDecibel);
  v.number({"sensitivity_dbm", "What is weaker is not heard"}, sensitivity_dbm, kLevel);
  v.number({"missed_share", "Share of access points that a scan does not find"}, missed_share, kShare);
}

void WorldBeaconRadioOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.flag({"ranges", "It measures ranges"}, ranges);
  v.flag({"levels", "It measures levels"}, levels);
  v.number({"height_m", "Of the antenna above the floor"}, height_m, {0.0, 1000.0});
  v.number({"sigma_range_m", "Noise of each range"}, sigma_range_m, kNoise);
  v.number({"bias_m", "Added to each range"}, bias_m, {-10.0, 10.0});
  v.number({"nlos_mean_m", "Mean of what each wall between adds to a range (exponential)"}, nlos_mean_m,
           kNoise);
  v.number({"range_max_m", "Farther beacons are not heard"}, range_max_m, {0.1, 1000.0});
  v.number({"sigma_db", "Noise of each level"}, sigma_db, kDecibel);
  v.number({"sensitivity_dbm", "What is weaker is not heard"}, sensitivity_dbm, kLevel);
  v.number({"missed_share", "Share of beacons that a round does not find"}, missed_share, kShare);
}

void WorldLandmarkDetectorOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.number({"field_of_view_rad", "Symmetric about its x axis"}, field_of_view_rad, {0.01, kTwoPi});
  v.number({"range_max_m", "Farther landmarks are not seen"}, range_max_m, {0.1, 1000.0});
  v.number({"sigma_range_m", "Noise of each range"}, sigma_range_m, kNoise);
  v.number({"sigma_range_share", "Noise that grows with the range"}, sigma_range_share, kShare);
  v.number({"sigma_bearing_rad", "Noise of each bearing"}, sigma_bearing_rad, {0.0, kPi});
  v.number({"missed_share", "Share of landmarks in view that are not seen"}, missed_share, kShare);
  v.number({"wrong_id_share", "Share of detections that name another landmark"}, wrong_id_share, kShare);
  v.number({"false_per_scan", "Mean number of detections where nothing is (Poisson)"}, false_per_scan,
           {0.0, 50.0});
}

void WorldCeilingCameraOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.integer({"pixels", "Along each side"}, pixels, {2.0, 1024.0});
  v.number({"side_m", "Of the square that it sees on the ceiling"}, side_m, {0.01, 100.0});
  v.number({"sigma_gray", "Noise of each pixel, of 255"}, sigma_gray, {0.0, 255.0});
  v.number({"sigma_exposure", "Relative brightness, drawn for each picture"}, sigma_exposure, kShare);
}

void WorldGyroscopeOptions::visit(OptionVisitor& v) {
  visit_mount(v, mount, timing);
  v.number({"sigma_radps", "Noise of each reading"}, sigma_radps, kNoise);
  v.number({"sigma_bias_radps", "Constant bias, drawn once"}, sigma_bias_radps, kNoise);
  v.number({"bias_walk_radps_per_sqrt_s", "Random walk of the bias"}, bias_walk_radps_per_sqrt_s, kNoise);
  v.number({"sigma_scale", "Relative error of the scale, drawn once"}, sigma_scale, kShare);
}

void WorldTransmitterOptions::visit(OptionVisitor& v) {
  v.text({"at", "x,y"}, at);
  v.number({"power_dbm", "Level at one metre"}, power_dbm, kLevel);
  v.number({"height_m", "Of a beacon above the floor"}, height_m, {0.0, 1000.0});
  v.number({"wrong_share", "Share of a beacon's ranges that are anything shorter than the truth"},
           wrong_share, {0.0, 1.0});
  v.number({"obstructed_share", "Share of a beacon's ranges that are late, whatever the map shows"},
           obstructed_share, {0.0, 1.0});
  v.number({"obstructed_mean_m", "Mean of what these are late (exponential)"}, obstructed_mean_m, kNoise);
}

void WorldLandmarkOptions::visit(OptionVisitor& v) {
  v.text({"at", "x,y"}, at);
  v.integer({"id", "What detectors call it; several may share one"}, id, {0.0, 1e9});
}

void WorldRadioOptions::visit(OptionVisitor& v) {
  v.number({"path_loss_exponent", "2 in the open, more among walls"}, path_loss_exponent, {0.5, 10.0});
  v.number({"opaque_loss_db", "Of each opaque wall on the line"}, opaque_loss_db, kDecibel);
  v.number({"glass_loss_db", "Of each glass wall"}, glass_loss_db, kDecibel);
  v.number({"mesh_loss_db", "Of each mesh"}, mesh_loss_db, kDecibel);
  v.number({"mirror_loss_db", "Of each mirror"}, mirror_loss_db, kDecibel);
  v.number({"door_loss_db", "Of each closed door"}, door_loss_db, kDecibel);
  v.number({"person_loss_db", "Of each person"}, person_loss_db, kDecibel);
  v.number({"sigma_shadowing_db", "Of the random field of each transmitter"}, sigma_shadowing_db, kDecibel);
  v.number({"shadowing_distance_m", "At which its correlation has fallen to 1/e"}, shadowing_distance_m,
           {0.05, 1000.0});
  v.integer({"pattern", "Another number, other fields; the seed changes none"}, pattern, {0.0, 1e9});
}

void WorldCeilingOptions::visit(OptionVisitor& v) {
  v.number({"height_m", "Above the floor"}, height_m, {0.1, 1000.0});
  v.number({"tile_m", "Side of a tile"}, tile_m, {0.05, 100.0});
  v.number({"lamp_share", "Share of tiles that are lamps"}, lamp_share, kShare);
  v.integer({"pattern", "Another number, another ceiling; the seed changes nothing"}, pattern, {0.0, 1e9});
}

}  // namespace cairn
