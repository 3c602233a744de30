#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"
#include "motion_models.hpp"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const RandomStream kRandom(1, RandomPurpose::kTest, 0);
// Ahead, backwards, a curve, in place, almost nothing, a half turn, sideways.
const std::vector<Pose2> kControls = {{0.3, 0, 0},      {-0.3, 0, 0}, {0.2, 0.05, 0.3},  {0, 0, 0.4},
                                      {-0.005, 0, 0.1}, {0, 0, -kPi}, {0.01, -0.2, -0.1}};

class MotionModelLaws : public ::testing::TestWithParam<MotionModelCase> {
 protected:
  std::vector<Pose2> propagated(const Pose2& control, std::vector<Pose2> states) const {
    GetParam().model->propagate(control, states, kRandom);
    return states;
  }
};

bool same_bytes(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pose2)) == 0;
}

TEST_P(MotionModelLaws, FiniteWithHeadingsInTheirInterval) {
  for (const Pose2& control : kControls) {
    for (const Pose2& start : {Pose2{}, Pose2{1e9, -1e9, -kPi}, Pose2{1, 2, 3.14159}}) {
      for (const Pose2& p : propagated(control, std::vector<Pose2>(2000, start))) {
        ASSERT_TRUE(is_finite(p));
        ASSERT_TRUE(p.theta >= -kPi && p.theta < kPi) << p.theta;
      }
    }
  }
}

TEST_P(MotionModelLaws, IndependentOfChunksAndPure) {
  const std::vector<Pose2> start(1000, Pose2{1, 2, 3});
  for (const Pose2& control : kControls) {
    const auto whole = propagated(control, start);
    EXPECT_TRUE(same_bytes(whole, propagated(control, start)));
    std::vector<Pose2> pieces = start;
    for (std::size_t begin = 0; begin < pieces.size(); begin += 40) {
      GetParam().model->propagate(control, std::span(pieces).subspan(begin, 40),
                                  kRandom.from_item(static_cast<std::uint32_t>(begin)));
    }
    EXPECT_TRUE(same_bytes(whole, pieces));
    EXPECT_FALSE(whole[0] == whole[1]);  // each particle has its own noise
  }
}

TEST_P(MotionModelLaws, FollowsTheStartPose) {
  const Pose2 T{-40, 7, 2.2}, start{1, 2, 3};
  for (const Pose2& control : kControls) {
    const auto here = propagated(control, std::vector<Pose2>(500, start));
    const auto there = propagated(control, std::vector<Pose2>(500, T * start));
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Pose2 expected = T * here[i];
      const double tolerance = 5e-11 + GetParam().precision * distance(here[i], start);
      ASSERT_NEAR(there[i].x, expected.x, tolerance);
      ASSERT_NEAR(there[i].y, expected.y, tolerance);
      ASSERT_NEAR(angle_difference(there[i].theta, expected.theta), 0.0, 1e-12 + 0.01 * GetParam().precision);
    }
  }
}

// Noise may shorten the mean of an arc a little (E cos of the noise), but must not bend or shift it: within
// a third of the samples' own spread, and within 4.9 standard errors in heading (false alarm 1e-6).
TEST_P(MotionModelLaws, TheMeanIsTheMotionOfTheOdometry) {
  constexpr std::size_t kSamples = 20'000;
  for (const Pose2& control : kControls) {
    const auto moved = propagated(control, std::vector<Pose2>(kSamples));
    const PoseMoments m = weighted_moments(moved, std::vector<double>(kSamples, 1.0));
    const auto sigma = [&](int k) { return std::sqrt(m.covariance(k, k)); };
    EXPECT_LE(std::abs(m.mean.x - control.x), 0.33 * sigma(0) + 1e-9) << control.x << ' ' << control.theta;
    EXPECT_LE(std::abs(m.mean.y - control.y), 0.33 * sigma(1) + 1e-9) << control.x << ' ' << control.theta;
    const double turn_error = angle_difference(m.mean.theta, control.theta);
    if (sigma(2) < 0.5) {
      EXPECT_LE(std::abs(turn_error), 4.9 * sigma(2) / std::sqrt(double{kSamples}) + 1e-9);
    }
  }
}

TEST_P(MotionModelLaws, RestIsRest) {
  const Pose2 start{1, 2, 3};
  const auto rested = propagated({0, 0, 0}, std::vector<Pose2>(100, start));
  for (const Pose2& p : rested) {
    if (GetParam().is_silent_at_rest) {
      EXPECT_EQ(p, start);
    }
    EXPECT_LT(distance(p, start), 0.1);
  }
}

TEST_P(MotionModelLaws, NoStatesAreNoTrouble) { EXPECT_TRUE(propagated({1, 0, 0}, {}).empty()); }

INSTANTIATE_TEST_SUITE_P(Conformance, MotionModelLaws, ::testing::ValuesIn(kMotionModels),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace cairn::test
