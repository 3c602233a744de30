#include "cairn/localization/pose_belief.hpp"

#include "monte_carlo_fixture.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::kStart;
using test::on_circle;

constexpr std::uint32_t kFirstRival = 1'000'000;

/// How the parts of the belief work together: search, monitor, recovery.
class PoseBeliefTest : public test::MonteCarloLocalizerTest {
 protected:
  double error_at_the_end(const Pose2& start) const {
    const Estimate& last = estimates_.back();
    return distance(last.T_map_base, on_circle(start, to_seconds(last.stamp)));
  }
  static bool claims_to_know(const Estimate& e) {
    return e.judgement.state == TrackingState::kTracking || e.judgement.state == TrackingState::kCrowded;
  }
};

// Every second the robot has a new look; the eighth comes after seven seconds.
TEST_F(PoseBeliefTest, ARobotThatMayBeAnywhereClaimsLittleUntilASearchConfirmsIt) {
  LocalizerOptions options;
  options.filter.min_particles = 1000;
  options.global.most_poses = 20;
  make(options, {});
  drive(20.0);
  for (const Estimate& e : estimates_) {
    if (e.stamp > at(6.5)) break;
    EXPECT_LE(e.judgement.probability, 0.9) << to_seconds(e.stamp);
    EXPECT_FALSE(claims_to_know(e)) << to_seconds(e.stamp);
  }
  EXPECT_GT(estimates_.back().judgement.probability, 0.9);
  EXPECT_TRUE(claims_to_know(estimates_.back()));
  EXPECT_LT(error_at_the_end(kStart), 0.15);
}

TEST_F(PoseBeliefTest, ARobotThatIsCarriedAwayHasRivalsAndIsFoundAgain) {
  const Pose2 elsewhere = kStart * Pose2{1.5, 1.0, 2.0};
  LocalizerOptions options;
  options.recovery.active = true;
  make(options);
  bool rivals_before = false, rivals_after = false;
  for (int i = 0; i < 400; ++i) {
    const double seconds = 0.05 * i;
    const bool carried = seconds > 5.0;
    odometry(seconds);
    if (i % 4 != 0) continue;
    const Pose2 truth = on_circle(carried ? elsewhere : kStart, seconds + 0.013);
    localizer_->process(test::scan_event(test::scan_from(map_, truth, at(seconds + 0.013))));
    const HypothesisSnapshot known = localizer_->hypotheses();
    const bool has_rivals = std::any_of(known.hypotheses.begin(), known.hypotheses.end(),
                                        [](const Hypothesis& h) { return h.id >= kFirstRival; });
    (carried ? rivals_after : rivals_before) |= has_rivals;
  }
  localizer_->finish();
  EXPECT_FALSE(rivals_before);
  EXPECT_TRUE(rivals_after);
  EXPECT_LT(error_at_the_end(elsewhere), 0.15);
  EXPECT_TRUE(claims_to_know(estimates_.back()));
}

}  // namespace
}  // namespace cairn
