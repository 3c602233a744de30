// What no schedule of late, lost, duplicated, shuffled, silent and malformed messages may break: the accounts
// balance, nothing freezes, the order of arrival within the history changes no byte, nor do threads.
//
// CAIRN_SCHEDULES sets the number of schedules (default 150, nightly 10,000).

#include "cairn/localization/monte_carlo_localizer.hpp"
#include "fault_schedule.hpp"

#include <cstdlib>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

using Kind = FaultSchedule::Kind;

std::uint64_t schedules() {
  const char* wanted = std::getenv("CAIRN_SCHEDULES");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 150;
}

LocalizerOptions options_of(const std::string& late_policy = "replay") {
  LocalizerOptions options;
  options.recipe = "mcl";
  options.filter.particles = 40;
  options.update = {0.0, 0.0};  // every scan is worth an update
  options.time.late_policy = late_policy;
  return options;
}

MonteCarloLocalizer make(const LocalizerOptions& options, int threads = 1) {
  static const MapLibrary kMaps(small_room());
  return MonteCarloLocalizer(options, FaultSchedule::streams(), kMaps, {FaultSchedule::start()}, 1,
                             std::make_shared<const Executor>(threads));
}

// All that a localizer knows in the end, as bytes.
std::string bytes_of(const Localizer& localizer) {
  std::string bytes;
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Pose2& pose : localizer.snapshot(100'000).particles) put(pose);
  if (const auto e = localizer.estimate()) {
    put(e->stamp);
    put(e->belief_stamp);
    put(e->T_map_base);
    put(e->T_map_odom);
    put(e->covariance);
    put(e->ess);
    put(e->quality);
  }
  return bytes;
}

std::string run(const LocalizerOptions& options, const std::vector<Event>& events, int threads = 1) {
  MonteCarloLocalizer localizer = make(options, threads);
  std::string told;
  localizer.set_observer([&](const Estimate& e) {
    told.append(reinterpret_cast<const char*>(&e.T_map_base), sizeof e.T_map_base);
  });
  for (const Event& event : events) localizer.process(event);
  localizer.finish();
  return bytes_of(localizer) + told;
}

std::string belief_after(const LocalizerOptions& options, const std::vector<Event>& events) {
  MonteCarloLocalizer localizer = make(options);
  for (const Event& event : events) localizer.process(event);
  localizer.finish();
  for (const OutcomeCounts& counts : localizer.outcomes()) {
    EXPECT_EQ(counts[static_cast<std::size_t>(Outcome::kDroppedStale)], 0) << "older than the history";
  }
  return bytes_of(localizer);
}

TEST(FaultCampaign, AnyOrderOfArrivalWithinTheHistoryGivesTheBytesOfTheSortedOrder) {
  std::size_t out_of_order = 0;
  for (std::uint64_t seed = 0; seed < schedules(); ++seed) {
    const FaultSchedule schedule(Kind::kDisorder, seed);
    const std::vector<Event> arrived = schedule.by_arrival(), sorted = schedule.by_stamp();
    for (std::size_t i = 1; i < arrived.size(); ++i) out_of_order += arrived[i].stamp < arrived[i - 1].stamp;
    const std::string expected = belief_after(options_of(), sorted);
    ASSERT_GT(expected.size(), 40 * sizeof(Pose2)) << seed;
    ASSERT_EQ(belief_after(options_of(), arrived) == expected, true) << seed;
  }
  EXPECT_GT(out_of_order, 10 * schedules()) << "the schedules are not what they should be";
}

// Policies, schedulers and budgets in turn.
LocalizerOptions mixed_options(std::uint64_t seed) {
  const char* late[] = {"replay", "delay", "drop"};
  const char* policies[] = {"all", "rate", "cfs"};
  LocalizerOptions options = options_of(late[seed % 3]);
  options.scheduler.policy = policies[seed / 3 % 3];
  options.scheduler.compute_share = seed / 9 % 2 == 0 ? 0.0 : 0.02;  // about half of what is asked for
  options.scheduler.cost_ns = 3000.0;
  options.scheduler.queue = 4;
  return options;
}

std::int64_t sum(const std::vector<OutcomeCounts>& outcomes) {
  std::int64_t total = 0;
  for (const OutcomeCounts& counts : outcomes) {
    for (const std::int64_t n : counts) {
      EXPECT_GE(n, 0);
      total += n;
    }
  }
  return total;
}

std::int64_t unknown_streams(const Localizer& localizer) {
  const auto& counts = localizer.diagnostics().counts();
  const auto found = counts.find("event of an unknown stream");
  return found == counts.end() ? 0 : found->second;
}

TEST(FaultCampaign, EveryMessageEndsInExactlyOneOutcome) {
  OutcomeCounts seen{};
  for (std::uint64_t seed = 0; seed < schedules(); ++seed) {
    MonteCarloLocalizer localizer = make(mixed_options(seed));
    std::int64_t received = 0;
    for (const Event& event : FaultSchedule(Kind::kWild, seed).by_arrival()) {
      localizer.process(event);
      ++received;
      ASSERT_EQ(sum(localizer.outcomes()) + unknown_streams(localizer), received) << seed;
    }
    localizer.finish();
    ASSERT_EQ(sum(localizer.outcomes()) + unknown_streams(localizer), received) << seed;
    for (const OutcomeCounts& counts : localizer.outcomes()) {
      ASSERT_EQ(counts[static_cast<std::size_t>(Outcome::kPending)], 0) << seed;
      for (std::size_t k = 0; k < kOutcomeCount; ++k) seen[k] += counts[k];
    }
  }
  for (std::size_t k = 0; k < kOutcomeCount; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    EXPECT_EQ(seen[k] > 0, outcome != Outcome::kPending) << to_string(outcome) << " was never tried";
  }
}

// Half of each schedule is wild, the other half is clean. Wrong stamps lie up to 4 s or far beyond the end:
// the last second must be used whole.
TEST(FaultCampaign, NothingFreezes) {
  for (std::uint64_t seed = 0; seed < schedules(); ++seed) {
    for (const char* late : {"replay", "delay", "drop"}) {
      MonteCarloLocalizer localizer = make(options_of(late));
      Time newest{};
      int told = 0;
      localizer.set_observer([&](const Estimate& e) {
        ASSERT_TRUE(is_finite(e.T_map_base) && e.covariance.allFinite()) << seed;
        newest = e.stamp;
        told += e.stamp > at(FaultSchedule::kEnd_s - 1.0) && e.stamp <= at(FaultSchedule::kEnd_s) ? 1 : 0;
      });
      for (const Event& event : FaultSchedule(Kind::kWild, seed).by_arrival()) localizer.process(event);
      localizer.finish();
      ASSERT_GE(told, 15) << seed << ' ' << late << ": ten scans of one laser, five of the other";
      ASSERT_EQ(newest, at(FaultSchedule::kEnd_s)) << seed << ' ' << late;
      ASSERT_EQ(localizer.estimate()->stamp, at(FaultSchedule::kEnd_s)) << seed << ' ' << late;
    }
  }
}

TEST(FaultCampaign, TheSameBytesForAnyNumberOfThreads) {
  for (std::uint64_t seed = 0; seed < schedules(); seed += 3) {
    const std::vector<Event> events = FaultSchedule(Kind::kWild, seed).by_arrival();
    const std::string one = run(mixed_options(seed), events, 1);
    for (const int threads : {1, 2, 7}) {
      ASSERT_EQ(run(mixed_options(seed), events, threads) == one, true) << seed << ' ' << threads;
    }
  }
}

}  // namespace
}  // namespace cairn::test
