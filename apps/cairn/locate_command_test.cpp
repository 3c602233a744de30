#include "apps/cairn/commands.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/map_yaml.hpp"
#include "tests/support/command_output.hpp"
#include "tests/support/small_room.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

/// A room and what a robot sees in it, as files.
class LocateCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    const OccupancyGrid room = test::small_room();
    write_map(folder_ / "room.yaml", room);
    const LaserScan scan = test::scan_from(room, kTruth, {}, 90);
    std::ofstream beams(folder_ / "scan.txt");
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
      beams << scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad << ' '
            << scan.ranges_m[i] << '\n';
    std::ofstream log(folder_ / "drive.clf");
    for (int step = 0; step < 20; ++step) write_flaser(log, room, step);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // 2.3 m along a line; the odometry begins elsewhere.
  static Pose2 at_step(int step) { return kTruth * Pose2{0.12 * step, 0.0, 0.0}; }
  static void write_flaser(std::ostream& out, const OccupancyGrid& room, int step) {
    constexpr int kBeams = 180;
    LaserScan scan = test::scan_from(room, at_step(step), {}, 360);
    const Pose2 odom = Pose2{5.0, -3.0, 1.0} * Pose2{0.12 * step, 0.0, 0.0};
    out << "FLASER " << kBeams;
    for (int i = 0; i < kBeams; ++i) out << ' ' << scan.ranges_m[static_cast<std::size_t>(90 + i)];
    for (int repeat = 0; repeat < 2; ++repeat) out << ' ' << odom.x << ' ' << odom.y << ' ' << odom.theta;
    out << ' ' << 10.0 + 0.5 * step << " host " << 10.0 + 0.5 * step << '\n';
  }
  nlohmann::json locate(const std::string& more) const {
    const std::string map = (folder_ / "room.yaml").string();
    return nlohmann::json::parse(test::output_of(add_locate, "locate --json --map " + map + " " + more));
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  static void expect_near(const nlohmann::json& pose, const Pose2& truth) {
    EXPECT_NEAR(pose["x_m"].get<double>(), truth.x, 0.08);
    EXPECT_NEAR(pose["y_m"].get<double>(), truth.y, 0.08);
    EXPECT_NEAR(normalize_angle(pose["yaw_rad"].get<double>() - truth.theta), 0.0, 0.03);
  }

  static constexpr Pose2 kTruth{2.0, 2.1, 0.7};
  fs::path folder_ = fs::temp_directory_path() / ("cairn_locate_test" + std::to_string(getpid()));
};

TEST_F(LocateCommand, FindsThePoseOfAScan) {
  const auto json = locate("--scan " + file("scan.txt"));
  EXPECT_TRUE(json["complete"].get<bool>());
  EXPECT_EQ(json["points"].get<int>(), 90);
  expect_near(json["poses"].at(0), kTruth);
  EXPECT_GT(json["poses"][0]["weight"].get<double>(), 0.7);  // half a turn looks similar but for the boxes
  EXPECT_GT(json["poses"][0]["covariance"][0][0].get<double>(), 0.0);
}

TEST_F(LocateCommand, FindsThePoseInALogAtATime) {
  const auto json = locate("--log " + file("drive.clf") + " --at 4");
  EXPECT_EQ(json["scans"].get<int>(), 1);
  EXPECT_NEAR(json["stamp_s"].get<double>(), 14.0, 1e-9);
  expect_near(json["poses"].at(0), at_step(8));
}

TEST_F(LocateCommand, JoinsTheScansOfAPath) {
  const auto json = locate("--log " + file("drive.clf") + " --at 9 --path 1.9 --top 1");
  EXPECT_EQ(json["scans"].get<int>(), 4);  // every fifth
  EXPECT_EQ(json["poses"].size(), 1u);
  expect_near(json["poses"].at(0), at_step(18));
}

TEST_F(LocateCommand, RefusesWhatItCannotDo) {
  EXPECT_THROW(locate(""), ConfigurationError);
  EXPECT_THROW(locate("--scan a --log b"), ConfigurationError);
  EXPECT_THROW(locate("--scan " + file("scan.txt") + " --top 0"), ConfigurationError);
  EXPECT_THROW(locate("--scan " + file("scan.txt") + " --budget nan"), ConfigurationError);
  EXPECT_THROW(locate("--scan " + file("scan.txt") + " --region 3 3 1 1"), ConfigurationError);
  EXPECT_THROW(locate("--log " + file("drive.clf") + " --at 100"), ConfigurationError);
  EXPECT_THROW(locate("--log " + file("drive.clf") + " --path -1"), ConfigurationError);
  EXPECT_THROW(locate("--scan " + file("absent.txt")), InputError);
}

}  // namespace
}  // namespace cairn::app
