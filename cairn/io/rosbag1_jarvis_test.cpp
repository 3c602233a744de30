// The real bag against text that was derived from it by other software.
#include "cairn/io/input_file.hpp"
#include "cairn/io/rosbag1.hpp"
#include "test_data.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr const char* kBag = "jarvis_nav350/jarvis_complex_path_fast.bag";
// The text prints microseconds, from a double that holds such stamps to 119 ns.
constexpr Duration kStampDigits(500 + 120);

std::string data(const char* relative) { return test::data_file(relative).string(); }

const Log& jarvis() {
  static const Log log = [] {
    const auto input = open_input(data(kBag));
    return read_rosbag1(*input, "jarvis");
  }();
  return log;
}

struct Row {
  Time stamp;
  std::vector<double> values;
};

std::vector<Row> rows(const char* relative) {
  const auto input = open_input(data(relative));
  std::vector<Row> table;
  for (std::string line; std::getline(*input, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream fields(line);
    std::string stamp;
    fields >> stamp;
    table.push_back({parse_time(stamp).value(), {std::istream_iterator<double>(fields), {}}});
  }
  return table;
}

std::vector<Event> events_of(const std::string& stream) {
  std::vector<Event> events;
  for (const Event& event : jarvis().events) {
    if (jarvis().streams.at(event.stream).name == stream) events.push_back(event);
  }
  return events;
}

const StreamInfo& stream(const std::string& name) {
  for (const StreamInfo& info : jarvis().streams) {
    if (info.name == name) return info;
  }
  throw std::runtime_error("no stream " + name);
}

void expect_same_scans(const std::string& name, const char* text) {
  const auto events = events_of(name);
  const auto table = rows(text);
  ASSERT_EQ(events.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const LaserScan& scan = *std::get<std::shared_ptr<const LaserScan>>(events[i].payload);
    EXPECT_LE(std::chrono::abs(events[i].stamp - table[i].stamp), kStampDigits);
    ASSERT_EQ(scan.ranges_m.size(), table[i].values.size());
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      ASSERT_NEAR(scan.ranges_m[beam], table[i].values[beam], 0.5001e-3) << "scan " << i << " beam " << beam;
    }
  }
}

TEST(JarvisBag, OdometryFromTfEqualsTheText) {
  CAIRN_SKIP_WITHOUT(kBag);
  const auto events = events_of("tf:odom->base_footprint");
  const auto table = rows("jarvis_nav350/text/complex_odom.txt");
  ASSERT_EQ(table.size(), 1850u);
  ASSERT_EQ(events.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Odometry& odometry = std::get<Odometry>(events[i].payload);
    EXPECT_LE(std::chrono::abs(events[i].stamp - table[i].stamp), kStampDigits);
    EXPECT_NEAR(odometry.T_odom_base.x, table[i].values[0], 0.5001e-5);
    EXPECT_NEAR(odometry.T_odom_base.y, table[i].values[1], 0.5001e-5);
    EXPECT_NEAR(odometry.T_odom_base.theta, table[i].values[2], 0.5001e-6);
  }
}

TEST(JarvisBag, SecurityScannerEqualsTheText) {
  CAIRN_SKIP_WITHOUT(kBag);
  expect_same_scans("/driver_laser_security/laser_scan", "jarvis_nav350/text/complex_s3000.txt.gz");
  EXPECT_EQ(events_of("/driver_laser_security/laser_scan").size(), 619u);
  const StreamInfo& info = stream("/driver_laser_security/laser_scan");
  EXPECT_EQ(info.frame, "base_laser_security_link");
  ASSERT_TRUE(info.T_base_sensor.has_value());
  EXPECT_EQ(*info.T_base_sensor, (Pose2{0.895, 0.0, 0.0}));
}

TEST(JarvisBag, NavigationScannerEqualsTheText) {
  CAIRN_SKIP_WITHOUT(kBag);
  expect_same_scans("/driver_laser_navigation/laser_scan", "jarvis_nav350/text/complex_nav350.txt.gz");
  EXPECT_EQ(events_of("/driver_laser_navigation/laser_scan").size(), 591u);
  ASSERT_TRUE(stream("/driver_laser_navigation/laser_scan").T_base_sensor.has_value());
  EXPECT_EQ(*stream("/driver_laser_navigation/laser_scan").T_base_sensor, (Pose2{0.194, 0.0, 0.0}));
}

TEST(JarvisBag, ScannersKeepTheirGeometry) {
  CAIRN_SKIP_WITHOUT(kBag);
  const Event first = events_of("/driver_laser_security/laser_scan").at(0);
  const LaserScan& scan = *std::get<std::shared_ptr<const LaserScan>>(first.payload);
  EXPECT_NEAR(scan.angle_min_rad, -1.658063, 0.5e-6);
  EXPECT_NEAR(scan.angle_increment_rad, 0.00436332, 0.5e-8);
  EXPECT_NEAR(scan.range_min_m, 0.10, 1e-6);
  EXPECT_NEAR(scan.range_max_m, 50.0, 1e-6);
}

TEST(JarvisBag, NothingElseIsAmiss) {
  CAIRN_SKIP_WITHOUT(kBag);
  EXPECT_EQ(jarvis().streams.size(), 3u);
  for (const auto& [kind, count] : jarvis().diagnostics.counts()) {
    EXPECT_TRUE(kind.starts_with("unsupported message (")) << kind << " " << count;
  }
}

// 150 kB chunks: every cut must be noticed, and the events be the first of the whole bag.
TEST(JarvisBag, CutsAreReported) {
  CAIRN_SKIP_WITHOUT(kBag);
  const auto input = open_input(data(kBag));
  const std::string bag{std::istreambuf_iterator<char>(*input), {}};
  for (std::size_t size = 5000; size < bag.size(); size += bag.size() / 7) {
    std::istringstream cut(bag.substr(0, size));
    const Log log = read_rosbag1(cut, "cut");
    EXPECT_EQ(log.diagnostics.counts().count("truncated"), 1u) << size;
    ASSERT_LT(log.events.size(), jarvis().events.size());
    for (std::size_t i = 0; i < log.events.size(); ++i) {
      ASSERT_EQ(log.events[i].stamp, jarvis().events[i].stamp);
    }
  }
}

}  // namespace
}  // namespace cairn
