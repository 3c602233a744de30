#include "cairn/sim/sensor_timing.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<MessageTiming> timings(const WorldTimingOptions& options, double end_s = 100.0,
                                   std::size_t stream = 0) {
  return message_timings(options, time_from_seconds(end_s), stream, 1);
}

TEST(SensorTiming, WithoutFaultsIsAClock) {
  const auto messages = timings({.rate_hz = 10.0}, 1.0);
  ASSERT_EQ(messages.size(), 11U);
  EXPECT_EQ(messages[3].measured, time_from_seconds(0.3));
  EXPECT_EQ(messages[3].stamp, messages[3].measured);
  EXPECT_EQ(messages[3].arrival, messages[3].measured);
}

TEST(SensorTiming, LatencyAndClockOffset) {
  for (const MessageTiming& m : timings({.rate_hz = 10.0, .latency_s = 0.3, .clock_offset_s = -0.05})) {
    EXPECT_NEAR(to_seconds(m.arrival - m.measured), 0.3, 1e-9);
    EXPECT_NEAR(to_seconds(m.stamp - m.measured), -0.05, 1e-9);
  }
}

TEST(SensorTiming, JitterKeepsTheOrderOfMeasuring) {
  const auto messages = timings({.rate_hz = 10.0, .jitter_s = 1.0});
  for (std::size_t i = 1; i < messages.size(); ++i) EXPECT_LT(messages[i - 1].measured, messages[i].measured);
  EXPECT_NE(messages[5].measured, time_from_seconds(0.5));
}

// 10000 messages, a tenth lost: 6 standard deviations are 180.
TEST(SensorTiming, LosesTheShareThatIsAsked) {
  const auto messages = timings({.rate_hz = 100.0, .lost_share = 0.1});
  EXPECT_NEAR(static_cast<double>(messages.size()), 9001.0, 180.0);
  EXPECT_GT(messages.back().index, messages.size()) << "lost ones are counted";
  EXPECT_TRUE(timings({.rate_hz = 10.0, .lost_share = 1.0}).empty());
}

TEST(SensorTiming, AStallHoldsMessagesBack) {
  const auto messages = timings({.rate_hz = 10.0, .stall_every_s = 10.0, .stall_s = 2.0});
  std::size_t held = 0;
  for (const MessageTiming& m : messages) {
    const double delay = to_seconds(m.arrival - m.measured);
    EXPECT_GE(delay, 0.0);
    EXPECT_LE(delay, 2.0 + 1e-9);
    held += delay > 0.0 ? 1 : 0;
  }
  EXPECT_GT(held, 50U);  // about a sixth of 1000 are expected
  EXPECT_LT(held, 400U);
}

// A sixth of the time is out: what is lost comes in bursts, and nothing else is held up.
TEST(SensorTiming, AnOutageLosesMessagesInBursts) {
  const auto messages = timings({.rate_hz = 10.0, .outage_every_s = 10.0, .outage_s = 2.0}, 1000.0);
  EXPECT_GT(messages.size(), 7000U);
  EXPECT_LT(messages.size(), 9500U);
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const std::uint64_t missing = messages[i].index - messages[i - 1].index - 1;
    gaps += missing > 0 ? 1 : 0;
    EXPECT_TRUE(missing == 0 || missing >= 19) << missing;
    EXPECT_EQ(messages[i].arrival, messages[i].measured);
  }
  EXPECT_GT(gaps, 40U);
}

TEST(SensorTiming, StreamsHaveFaultsOfTheirOwn) {
  const WorldTimingOptions options{.rate_hz = 10.0, .latency_jitter_s = 0.1};
  EXPECT_EQ(timings(options)[4].arrival, timings(options)[4].arrival);
  EXPECT_NE(timings(options)[4].arrival, timings(options, 100.0, 1)[4].arrival);
}

}  // namespace
}  // namespace cairn
