#include "cairn/eval/score.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

Trajectory circle(double phase = 0.0) {
  Trajectory poses;
  for (int i = 0; i <= 100; ++i) {
    const double a = 0.05 * i + phase;
    poses.push_back(
        {time_from_seconds(0.1 * i), {2 * std::cos(a), 2 * std::sin(a), normalize_angle(a + kPi / 2)}});
  }
  return poses;
}

TEST(Score, OfTheReferenceItselfIsPerfect) {
  const Score s = score(circle(), circle());
  EXPECT_EQ(s.ate.position_m.max, 0.0);
  EXPECT_NEAR(s.rpe.translation_max_m, 0.0, 1e-12);
  EXPECT_GT(s.rpe.pairs, 50u);
  EXPECT_EQ(s.coverage, 1.0);
  EXPECT_FALSE(s.lost.lost);
}

TEST(Score, AlignsOnlyWhenAsked) {
  Trajectory moved = circle();
  for (auto& sample : moved) sample.pose = Pose2{3, 4, 0.0} * sample.pose;
  EXPECT_NEAR(score(circle(), moved).ate.position_m.mean, 5.0, 1e-12);
  EXPECT_TRUE(score(circle(), moved).lost.lost);
  const Score s = score(circle(), moved, {.alignment = Alignment::kRigid});
  EXPECT_NEAR(s.ate.position_m.max, 0.0, 1e-12);
  EXPECT_NEAR(s.T_reference_estimate.x, -3.0, 1e-12);
}

TEST(Score, MovesTheEstimateIntoTheReferencesFrame) {
  const Pose2 T_base_laser{0.3, 0.1, 0.2};
  const Trajectory laser = move_in_own_frame(circle(), T_base_laser);
  EXPECT_GT(score(laser, circle()).ate.position_m.mean, 0.3);
  EXPECT_NEAR(score(laser, circle(), {.T_estimate_reference = T_base_laser}).ate.position_m.max, 0.0, 1e-12);
}

TEST(Score, SaysHowMuchOfTheReferenceIsCovered) {
  Trajectory half = circle();
  half.resize(51);
  EXPECT_NEAR(score(circle(), half).coverage, 51.0 / 101.0, 1e-12);
}

TEST(Score, OfDisjointRunsIsAnError) {
  Trajectory later = circle();
  for (auto& sample : later) sample.stamp += std::chrono::hours(1);
  EXPECT_THROW(score(circle(), later), InputError);
  EXPECT_THROW(score({}, circle()), InputError);
  EXPECT_THROW(score(circle(), {}), InputError);
}

TEST(Score, GivesItsFiguresAsJson) {
  const Score s = score(circle(), circle(0.01));
  const auto json = nlohmann::json::parse(to_json(s));
  EXPECT_EQ(json["position"]["mean_m"].get<double>(), s.ate.position_m.mean);
  EXPECT_EQ(json["heading"]["max_rad"].get<double>(), s.ate.heading_rad.max);
  EXPECT_EQ(json["relative"]["pairs"].get<std::size_t>(), s.rpe.pairs);
  EXPECT_EQ(json["matched_samples"].get<std::size_t>(), 101u);
  EXPECT_FALSE(json["lost"].get<bool>());
}

}  // namespace
}  // namespace cairn
