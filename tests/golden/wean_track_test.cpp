// A recording on which the map misleads (docs/recovery.md): for a minute another place explains more of what
// is seen than the true one, which the robot has never left.
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "test_data.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr Pose2 kStart{39.83, 41.57, -1.62};

LocalizerOptions wean_options() {
  LocalizerOptions options;
  options.odometry_stream = "laser_odom";
  options.streams["laser"].limits.max_range_m = 49.0;
  return options;
}

TEST(WeanTrack, ARobotThatHasBeenTrackedIsNotLedAway) {
  CAIRN_SKIP_WITHOUT("wean/robotdata2.log");
  Log log = read_log(test::data_file("wean/robotdata2.log"));
  sort_by_stamp(log);
  Diagnostics diagnostics;
  const auto maps = read_map_set(test::data_file("wean/wean.dat.gz"), diagnostics);
  for (const Pose2& error : {Pose2{0.2, 0.0, 0.087}, Pose2{0.0, -0.2, -0.087}}) {
    const Pose2 start{kStart.x + error.x, kStart.y + error.y, kStart.theta + error.theta};
    MonteCarloLocalizer localizer(wean_options(), log.streams, maps->grid(), {start}, 1,
                                  std::make_shared<const Executor>(1));
    std::optional<Pose2> last;
    double longest = 0.0;
    localizer.set_observer([&](const Estimate& e) {
      if (last && e.stamp > log.events.front().stamp + std::chrono::seconds(2))  // the start's error goes
        longest = std::max(longest, distance(*last, e.T_map_base));
      last = e.T_map_base;
    });
    for (const Event& event : log.events) localizer.process(event);
    localizer.finish();
    EXPECT_LT(longest, 0.5);
    // After 240 s it is back where it began.
    EXPECT_LT(distance(*last, {40.17, 42.24, 0.0}), 0.3) << last->x << ' ' << last->y;
  }
}

}  // namespace
}  // namespace cairn
