// The run-time core does not touch the heap once it runs: everything but the models and the filter, which are
// fakes here. A program of its own, for it replaces operator new.

#include "fake_fusion.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

namespace {
std::atomic<std::int64_t> g_allocations{0};
}

// Never inlined: GCC 12 warns of a mismatch where it inlines only one of a pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace cairn::test {
namespace {

std::vector<Event> minutes_of_events(double from_s, double to_s) {
  std::vector<Event> events;
  for (int tick = static_cast<int>(from_s * 100); tick < static_cast<int>(to_s * 100); ++tick) {
    const double t = 0.01 * tick;
    events.push_back(odometry_event(t, on_circle({}, t)));
    if (tick % 5 == 0) events.push_back(fake_measurement(t - 0.003, 1));
    if (tick % 10 == 7) events.push_back(fake_measurement(t - 0.5, 2, 0.5));  // late: put at its true time
  }
  return events;
}

std::int64_t allocations_of(FusionLocalizer& localizer, const std::vector<Event>& events) {
  const std::int64_t before = g_allocations;
  for (const Event& event : events) localizer.process(event);
  return g_allocations - before;
}

void expect_none(const char* late_policy, const char* scheduler, double compute_share) {
  FusionParts parts = fake_parts(nullptr, {1.0, 5.0});
  parts.time.late_policy = late_policy;
  parts.scheduler.policy = scheduler;
  parts.scheduler.compute_share = compute_share;
  FusionLocalizer localizer(std::move(parts));
  EXPECT_GT(allocations_of(localizer, minutes_of_events(0.0, 60.0)), 0) << "it has to grow at first";
  EXPECT_EQ(allocations_of(localizer, minutes_of_events(60.0, 180.0)), 0) << late_policy << ' ' << scheduler;
  EXPECT_GT(localizer.updates(), 800);
}

TEST(SteadyState, TheCoreDoesNotAllocate) {
  expect_none("replay", "all", 0.0);
  expect_none("delay", "all", 0.0);
  expect_none("drop", "rate", 0.0);
}

TEST(SteadyState, NeitherUnderAScheduler) { expect_none("replay", "cfs", 0.5); }

}  // namespace
}  // namespace cairn::test
