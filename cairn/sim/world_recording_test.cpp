#include "cairn/sim/world_recording.hpp"

#include "small_world.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

World busy_world() {
  WorldOptions options = test::small_world_options();
  options.people.walking = 2;
  options.lasers.emplace_back().name = "depth";
  options.lasers.back().timing.rate_hz = 5.0;
  options.lasers.back().timing.latency_s = 0.3;
  options.lasers.back().beams = 31;
  return make_world(options);
}

bool same_events(const WorldRecording& a, const WorldRecording& b) {
  if (a.events.size() != b.events.size()) return false;
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    const Event &x = a.events[i], &y = b.events[i];
    if (x.stamp != y.stamp || x.arrival != y.arrival || x.stream != y.stream) return false;
    const auto* scan = std::get_if<std::shared_ptr<const LaserScan>>(&x.payload);
    if (scan != nullptr &&
        (*scan)->ranges_m != std::get<std::shared_ptr<const LaserScan>>(y.payload)->ranges_m)
      return false;
  }
  return true;
}

TEST(WorldRecording, TheSameForAnyNumberOfThreads) {
  const World world = busy_world();
  const WorldRecording one = record_world(world, 1);
  EXPECT_TRUE(same_events(one, record_world(world, 1, Executor(7))));
  EXPECT_FALSE(same_events(one, record_world(world, 2)));
  EXPECT_EQ(one.truth, record_world(world, 1, Executor(2)).truth);
}

TEST(WorldRecording, StreamsComeInTheOrderOfArrival) {
  const WorldRecording recording = record_world(busy_world(), 1);
  ASSERT_EQ(recording.streams.size(), 3U);
  EXPECT_EQ(recording.streams[2].name, "depth");
  std::vector<std::size_t> count(3, 0);
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Event& event = recording.events[i];
    ++count[event.stream];
    if (i > 0) {
      EXPECT_LE(recording.events[i - 1].arrival, event.arrival);
    }
    if (event.stream == 2) {
      EXPECT_NEAR(to_seconds(event.arrival - event.stamp), 0.3, 1e-9);
    }
  }
  const double seconds = to_seconds(recording.truth.back().stamp);
  EXPECT_NEAR(static_cast<double>(count[0]), 25.0 * seconds, 2.0);
  EXPECT_NEAR(static_cast<double>(count[1]), 10.0 * seconds, 2.0);
  EXPECT_NEAR(static_cast<double>(count[2]), 5.0 * seconds, 2.0);
}

}  // namespace
}  // namespace cairn
