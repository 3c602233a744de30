#include "cairn/io/mrpt_text_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/text_log.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace cairn {
namespace {

constexpr double kFarthestBeacon_m = 1e5;
// The aperture is printed with six decimals: a full turn may come out a little larger.
constexpr double kWidestApertureRad = kTwoPi + 1e-5;
constexpr const char* kWithoutStamp = "beacon without stamp";
constexpr const char* kNoLaser = "a frame has BEACON, but no LASER to tell when";

class Reader {
 public:
  void read_message(FieldReader& fields, TextLogBuilder& builder) {
    const std::string_view name = fields.word("line type");
    if (name == "FRAME") {
      read_frame(fields, builder);
    } else if (name == "ODO") {
      read_increment(fields);
    } else if (name == "LASER") {
      read_laser(fields, builder);
    } else if (name == "BEACON") {
      read_beacon(fields, builder);
    } else {
      fields.fail("the line starts with none of FRAME, ODO, LASER, BEACON", "check how the log was made");
    }
  }

  /// Whether the log ends with beacons that no LASER gave a stamp.
  bool has_beacons_left() const { return !beacons_.empty(); }

 private:
  void read_frame(FieldReader& fields, TextLogBuilder& builder) {
    fields.integer("frame number");
    fields.expect_end();
    if (!beacons_.empty()) builder.warn(kWithoutStamp, kNoLaser);
    beacons_.clear();
    T_odom_base_ = T_odom_base_ * T_this_next_;
    T_this_next_ = {};
  }

  void read_increment(FieldReader& fields) {
    const Pose2 increment = read_pose(fields);
    fields.expect_end();
    T_this_next_ = T_this_next_ * increment;
  }

  void read_laser(FieldReader& fields, TextLogBuilder& builder) {
    auto scan = std::make_shared<LaserScan>();
    const Time stamp = scan->stamp = fields.time("timestamp");
    const long long count = fields.integer("number of beams");
    if (count < 2) fields.fail("number of beams is " + std::to_string(count), "it is at least 2");
    scan->range_max_m = fields.number("maximum range");
    if (scan->range_max_m <= 0.0) fields.fail("maximum range is not positive", "write metres");
    scan->range_min_m = kTextLogRangeMinM;
    const double aperture = fields.number("aperture");
    if (aperture <= 0.0 || aperture > kWidestApertureRad)
      fields.fail("aperture beyond (0, 2 pi]", "write radians");
    const double x = fields.number("x of the sensor");
    const double y = fields.number("y of the sensor");
    fields.number("height of the sensor");
    scan->ranges_m = read_ranges(fields, count);
    fields.expect_end();
    scan->angle_min_rad = -aperture / 2.0;
    scan->angle_increment_rad = aperture / static_cast<double>(count - 1);
    builder.add_odometry(builder.stream("odom", StreamKind::kOdometry), stamp, stamp, T_odom_base_);
    const StreamId laser = builder.stream("laser", StreamKind::kLaserScan);
    builder.observe_mount(laser, {x, y, 0.0});
    builder.add_scan(laser, stamp, std::move(scan));
    add_beacons(stamp, builder);
  }

  // Told before the laser of their frame, which has the stamp.
  void read_beacon(FieldReader& fields, TextLogBuilder& builder) {
    const long long id = fields.integer("beacon");
    const double range_m = fields.number("range");
    fields.expect_end();
    if (!(range_m >= 0.0 && range_m <= kFarthestBeacon_m))
      fields.fail("range is negative or beyond 100 km", "write metres");
    if (range_m == 0.0) return;
    const std::string name = std::to_string(id);
    const auto is_same = [&](const BeaconReading& reading) { return reading.id == name; };
    if (std::any_of(beacons_.begin(), beacons_.end(), is_same)) {
      builder.warn("beacon told twice", "a frame has two ranges of beacon " + name + "; the first is kept");
      return;
    }
    beacons_.push_back({name, range_m});
  }

  void add_beacons(Time stamp, TextLogBuilder& builder) {
    if (beacons_.empty()) return;
    const StreamId uwb = builder.stream("uwb", StreamKind::kBeaconRanges);
    builder.add_beacons(uwb, {stamp, std::exchange(beacons_, {})});
  }

  std::vector<BeaconReading> beacons_;  ///< of this frame
  Pose2 T_odom_base_;
  Pose2 T_this_next_;  ///< motion from this frame to the next
};

}  // namespace

Log read_mrpt_text_log(std::istream& input, const std::string& name) {
  Reader reader;
  Log log = read_text_log(input, name, "mrpt_text", [&reader](FieldReader& fields, TextLogBuilder& builder) {
    reader.read_message(fields, builder);
  });
  if (reader.has_beacons_left()) log.diagnostics.warn(kWithoutStamp, name, kNoLaser);
  return log;
}

}  // namespace cairn
