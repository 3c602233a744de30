// How well consecutive scans of real robots go on, and scans from elsewhere do not: the figures of
// decision 99.
#include "cairn/models/sensor/scan_continuity.hpp"

#include "cairn/core/rng.hpp"
#include "cairn/core/trajectory.hpp"
#include "cairn/io/log_reader.hpp"
#include "test_data.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kThreshold = 0.75;  // recovery.continued
constexpr double kElsewhere_s = 20.0;

struct Recording {
  const char* name;
  const char* file;
  const char* laser;
  const char* odometry;
  double most_broken;     // share of consecutive scans that may seem not to go on
  double least_detected;  // share of the pairs from elsewhere that must
};

struct PosedScan {
  std::shared_ptr<const LaserScan> scan;
  Pose2 T_odom_base;
};

class ScanContinuityOf : public ::testing::TestWithParam<Recording> {
 protected:
  void read() {
    Log log = read_log(test::data_file(GetParam().file));
    sort_by_stamp(log);
    Trajectory odometry;
    for (const Event& event : log.events) {
      const auto* o = std::get_if<Odometry>(&event.payload);
      if (o && log.streams[event.stream].name == GetParam().odometry)
        odometry.push_back({o->stamp, o->T_odom_base});
    }
    sort_by_stamp(odometry);
    for (const Event& event : log.events) {
      const auto* scan = std::get_if<std::shared_ptr<const LaserScan>>(&event.payload);
      if (!scan || log.streams[event.stream].name != GetParam().laser) continue;
      T_base_sensor_ = log.streams[event.stream].T_base_sensor.value_or(Pose2{});
      if (const auto pose = pose_at(odometry, event.stamp)) scans_.push_back({*scan, *pose});
    }
  }

  std::vector<PosedScan> scans_;
  Pose2 T_base_sensor_;
};

struct Count {
  int below = 0, all = 0;
  void add(const std::optional<double>& share) {
    if (!share) return;
    ++all;
    below += *share < kThreshold;
  }
  double share() const { return static_cast<double>(below) / all; }
};

TEST_P(ScanContinuityOf, ConsecutiveScansAndThoseFromElsewhere) {
  CAIRN_SKIP_WITHOUT(GetParam().file);
  read();
  const ScanContinuity continuity(T_base_sensor_, {.max_range_m = 49.0});
  const RandomStream random(1, RandomPurpose::kTest, 0);
  Count consecutive, elsewhere;
  for (std::size_t i = 0; i + 1 < scans_.size(); ++i) {
    const LaserScan& before = *scans_[i].scan;
    const Pose2 step = inverse(scans_[i].T_odom_base) * scans_[i + 1].T_odom_base;
    consecutive.add(continuity.share(before, *scans_[i + 1].scan, step));
    const double u = random.uniform4(static_cast<std::uint32_t>(i))[0];
    const LaserScan& other = *scans_[static_cast<std::size_t>(u * static_cast<double>(scans_.size()))].scan;
    if (std::abs(to_seconds(other.stamp - before.stamp)) >= kElsewhere_s)
      elsewhere.add(continuity.share(before, other, step));
  }
  std::printf("%s: %.2f %% of %d consecutive scans below %.2f, %.1f %% of %d from elsewhere\n",
              GetParam().name, 100.0 * consecutive.share(), consecutive.all, kThreshold,
              100.0 * elsewhere.share(), elsewhere.all);
  EXPECT_LE(consecutive.share(), GetParam().most_broken);
  EXPECT_GE(elsewhere.share(), GetParam().least_detected);
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, ScanContinuityOf,
    ::testing::Values(Recording{"wean 1", "wean/robotdata1.log", "laser", "laser_odom", 0.005, 0.99},
                      Recording{"wean 2", "wean/robotdata2.log", "laser", "laser_odom", 0.001, 0.975},
                      Recording{"intel", "radish_raw/intel.clf.bz2", "flaser", "flaser_odom", 0.001, 0.98},
                      Recording{"aces", "radish_raw/aces.clf.bz2", "flaser", "flaser_odom", 0.007, 0.99},
                      Recording{"jarvis", "jarvis_nav350/jarvis_complex_path_fast.bag",
                                "/driver_laser_security/laser_scan", "tf:odom->base_footprint", 0.001, 0.90},
                      Recording{"mrpt_uwb", "mrpt_uwb_laser/log.txt", "laser", "odom", 0.005, 0.97}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::erase(name, ' ');
      return name;
    });

}  // namespace
}  // namespace cairn
