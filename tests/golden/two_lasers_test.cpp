// Two lasers at different heights on the map of the lower one (docs/fusion.md): the upper one looks over a
// quarter of its walls, wherever the robot is.
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "test_data.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr const char* kLow = "/driver_laser_security/laser_scan";
constexpr const char* kHigh = "/driver_laser_navigation/laser_scan";

class TwoLasers : public testing::Test {
 protected:
  void SetUp() override {
    CAIRN_SKIP_WITHOUT("jarvis_nav350/jarvis_complex_path_fast.bag");
    log_ = read_log(test::data_file("jarvis_nav350/jarvis_complex_path_fast.bag"));
    sort_by_stamp(log_);
    reference_ = read_trajectory(test::data_file("jarvis_nav350/text/complex_gt.txt"));
    Diagnostics diagnostics;
    map_ = read_map_set(test::data_file("jarvis_nav350/maps/derived_from_circular_run.yaml"), diagnostics)
               ->grid();
    options_.odometry_stream = "tf:odom->base_footprint";
    for (const char* stream : {kLow, kHigh}) options_.streams[stream].limits.max_range_m = 49.0;
  }

  // Largest error, and the share of the estimates that are said to be lost.
  struct Run {
    double largest_m = 0.0;
    double lost = 0.0;
  };
  Run run() const {
    const Pose2 start = reference_.front().pose * Pose2{0.2, 0.0, 0.087};
    MonteCarloLocalizer localizer(options_, log_.streams, map_, {start}, 1,
                                  std::make_shared<const Executor>(1));
    Run run;
    int estimates = 0;
    localizer.set_observer([&](const Estimate& e) {
      const auto truth = pose_at(reference_, e.stamp);
      if (!truth) return;
      ++estimates;
      run.lost += e.judgement.state == TrackingState::kLost ? 1.0 : 0.0;
      run.largest_m = std::max(run.largest_m, distance(*truth, e.T_map_base));
    });
    for (const Event& event : log_.events) localizer.process(event);
    localizer.finish();
    run.lost /= estimates;
    return run;
  }

  Log log_;
  Trajectory reference_;
  std::shared_ptr<const OccupancyGrid> map_;
  LocalizerOptions options_;
};

TEST_F(TwoLasers, OneThatTheMapDoesNotFitLeadsNobodyAstray) {
  const Run both = run();
  EXPECT_LT(both.largest_m, 0.5);
  EXPECT_LT(both.lost, 0.1);
}

}  // namespace
}  // namespace cairn
