#include "cairn/sim/office_recording.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

OfficeRecordingOptions short_drive() {
  OfficeRecordingOptions options;
  options.duration = duration_from_seconds(20.0);
  return options;
}

const LaserScan* scan_of(const Event& event) {
  const auto* scan = std::get_if<std::shared_ptr<const LaserScan>>(&event.payload);
  return scan != nullptr ? scan->get() : nullptr;
}

bool same(const Event& a, const Event& b) {
  if (a.stamp != b.stamp || a.stream != b.stream) return false;
  const LaserScan* scan = scan_of(a);
  if (scan != nullptr) return scan->ranges_m == scan_of(b)->ranges_m;
  return std::get<Odometry>(a.payload).T_odom_base == std::get<Odometry>(b.payload).T_odom_base;
}

TEST(OfficeRecording, IsAFunctionOfItsSeed) {
  const OfficeRecording a = record_office(short_drive(), 5);
  const OfficeRecording b = record_office(short_drive(), 5);
  EXPECT_TRUE(std::equal(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(), same));
  EXPECT_EQ(a.truth, b.truth);
  EXPECT_EQ(a.map.cells(), b.map.cells());
  const OfficeRecording c = record_office(short_drive(), 6);
  EXPECT_FALSE(std::equal(a.events.begin(), a.events.end(), c.events.begin(), c.events.end(), same));
}

TEST(OfficeRecording, HasOdometryAt25AndScansAt10Hertz) {
  const OfficeRecording recording = record_office(short_drive(), 1);
  const auto of = [&](StreamId id) {
    return std::count_if(recording.events.begin(), recording.events.end(),
                         [&](const Event& e) { return e.stream == id; });
  };
  EXPECT_EQ(of(0), 20 * 25 + 1);
  EXPECT_EQ(of(1), 20 * 10 + 1);
  EXPECT_TRUE(std::is_sorted(recording.events.begin(), recording.events.end(),
                             [](const Event& a, const Event& b) { return a.stamp < b.stamp; }));
  EXPECT_EQ(recording.streams.at(1).T_base_sensor, (Pose2{0.2, 0.0, 0.0}));
}

// Share of the valid beams that end on or next to an occupied cell, seen from the true pose.
double explained_share(const OfficeRecording& recording) {
  int explained = 0;
  int beams = 0;
  for (const Event& event : recording.events) {
    const LaserScan* scan = scan_of(event);
    if (scan == nullptr) continue;
    const Pose2 T_map_laser = pose_at(recording.truth, event.stamp).value() * Pose2{0.2, 0.0, 0.0};
    for (std::size_t i = 0; i < scan->ranges_m.size(); ++i) {
      const double range = scan->ranges_m[i];
      if (!scan->is_valid_range(scan->ranges_m[i])) continue;
      const double angle = scan->angle_min_rad + static_cast<double>(i) * scan->angle_increment_rad;
      const Point2 end = T_map_laser * Point2{range * std::cos(angle), range * std::sin(angle)};
      ++beams;
      bool near = false;
      for (const double dx : {-0.05, 0.0, 0.05}) {
        for (const double dy : {-0.05, 0.0, 0.05}) {
          near = near || recording.map.state_at({end.x + dx, end.y + dy}) == CellState::kOccupied;
        }
      }
      explained += near ? 1 : 0;
    }
  }
  return static_cast<double>(explained) / beams;
}

TEST(OfficeRecording, ScansFromTheTruePosesFallOntoTheMap) {
  OfficeRecordingOptions options = short_drive();
  options.office.people = 0;
  EXPECT_GT(explained_share(record_office(options, 1)), 0.999);
}

TEST(OfficeRecording, PeopleAreSeenButNotMapped) {
  OfficeRecordingOptions options = short_drive();
  options.duration = duration_from_seconds(60.0);
  const double share = explained_share(record_office(options, 1));
  EXPECT_LT(share, 0.999);
  EXPECT_GT(share, 0.9);
}

TEST(OfficeRecording, OneTourTakesThreeToFiveMinutesThroughTenRooms) {
  OfficeRecordingOptions options;
  options.laser.beams = 2;  // the way is what counts here
  const OfficeRecording recording = record_office(options, 1);
  const double seconds = to_seconds(recording.truth.back().stamp);
  EXPECT_GT(seconds, 180.0);
  EXPECT_LT(seconds, 300.0);
  for (const Rectangle& room : recording.world.rooms) {
    EXPECT_TRUE(std::any_of(recording.truth.begin(), recording.truth.end(), [&](const StampedPose& p) {
      return std::hypot(p.pose.x - room.center().x, p.pose.y - room.center().y) < 0.2;
    }));
  }
}

TEST(OfficeRecording, RefusesOptionsOutOfRange) {
  OfficeRecordingOptions options;
  options.scan_every = 0;
  EXPECT_THROW(record_office(options, 1), ConfigurationError);
}

}  // namespace
}  // namespace cairn
