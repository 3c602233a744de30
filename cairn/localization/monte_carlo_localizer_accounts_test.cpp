#include "cairn/core/rng.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "monte_carlo_fixture.hpp"
#include "small_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::few_particles;
using test::kStart;
using test::MonteCarloLocalizerTest;
using test::odometry_event;
using test::on_circle;
using test::scan_event;
using test::scan_from;

// Random schedules with every fault that a stream of events can have.
class Schedule {
 public:
  Schedule(const OccupancyGrid& map, std::uint64_t seed)
      : random_(seed, RandomPurpose::kSimulation, 0), scan_(scan_from(map, kStart, Time{}, 12)) {
    for (int i = 0; i < 120; ++i) events_.push_back(draw(0.05 * i));
    for (std::size_t i = 1; i < events_.size(); ++i) {
      if (chance(0.1)) std::swap(events_[i], events_[i - 1]);
      if (chance(0.05)) events_[i] = events_[i - 1];
    }
  }

  const std::vector<Event>& events() const { return events_; }

 private:
  double uniform() { return random_.uniform4(item_++)[0]; }
  bool chance(double p) { return uniform() < p; }

  double wrong_stamp() {
    const double stamps[] = {-1e6, 0.0, 1e6, 9e9, -9e9, 20.0, 3.2e7};
    return stamps[static_cast<std::size_t>(7 * uniform())];
  }

  StreamId stream() {
    return chance(0.1) ? static_cast<StreamId>(7 * uniform()) : static_cast<StreamId>(2 * uniform());
  }

  Event draw(double seconds) {
    const double t = chance(0.1) ? wrong_stamp() : seconds;
    const StreamId id = stream();
    Event event = chance(0.95) == (id == 0) ? odometry(t, id) : scan(t, id);
    if (chance(0.03)) event.stamp += Duration(1);
    return event;
  }

  Event odometry(double t, StreamId id) {
    Pose2 pose = on_circle({}, std::fmod(t, 10.0));
    if (chance(0.03)) pose.x = std::nan("");
    if (chance(0.03)) pose.y = 1e300;
    return odometry_event(t, pose, id);
  }

  Event scan(double t, StreamId id) {
    LaserScan scan = scan_;
    scan.stamp = at(t);
    if (chance(0.03)) scan.ranges_m.clear();
    if (chance(0.03)) scan.angle_increment_rad = 1e308;
    if (chance(0.03)) return {scan.stamp, scan.stamp, id, std::shared_ptr<const LaserScan>()};
    return scan_event(scan, id);
  }

  RandomStream random_;
  std::uint32_t item_ = 0;
  LaserScan scan_;
  std::vector<Event> events_;
};

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

TEST_F(MonteCarloLocalizerTest, AccountsForEveryEventWhateverComes) {
  streams_.push_back({"rear", StreamKind::kLaserScan, "", Pose2{}});
  streams_.push_back({"wheels", StreamKind::kOdometry, "", {}});
  LocalizerOptions options = few_particles();
  options.filter.particles = 20;
  options.streams["laser"] = {};
  OutcomeCounts seen{};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    make(options, {kStart}, 1, seed);
    const Schedule schedule(map_, seed);
    std::int64_t received = 0;
    for (const Event& event : schedule.events()) {
      localizer_->process(event);
      ++received;
      ASSERT_EQ(sum(localizer_->outcomes()) + warnings("event of an unknown stream"), received) << seed;
    }
    localizer_->finish();
    ASSERT_EQ(sum(localizer_->outcomes()) + warnings("event of an unknown stream"), received) << seed;
    for (const OutcomeCounts& counts : localizer_->outcomes()) {
      ASSERT_EQ(counts[static_cast<std::size_t>(Outcome::kPending)], 0) << seed;
      for (std::size_t k = 0; k < kOutcomeCount; ++k) seen[k] += counts[k];
    }
    ASSERT_EQ(localizer_->updates(), count(Outcome::kUsed) + count(Outcome::kReplayed));
    for (const Estimate& e : estimates_)
      ASSERT_TRUE(is_finite(e.T_map_base) && e.covariance.allFinite()) << seed;
    const bool in_order = std::is_sorted(estimates_.begin(), estimates_.end(),
                                         [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    const bool set_back = warnings("clock set back") + warnings("arrival clock set back") > 0;
    ASSERT_TRUE(in_order || set_back) << seed;
  }
  for (std::size_t k = 0; k < kOutcomeCount; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    const bool budget = outcome == Outcome::kDeferred || outcome == Outcome::kDroppedOverBudget;
    EXPECT_EQ(seen[k] > 0, outcome != Outcome::kPending && !budget) << to_string(outcome);
  }
}

}  // namespace
}  // namespace cairn
