#include "cairn/eval/lost.hpp"

#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

/// One sample a second for 100 s, bad by position from `first` up to but not including `last`.
std::vector<PoseError> bad_between(int first, int last, double position_m = 1.5, double heading_rad = 0.0) {
  std::vector<PoseError> errors;
  for (int i = 0; i < 100; ++i) {
    const bool bad = i >= first && i < last;
    errors.push_back({time_from_seconds(i), bad ? position_m : 0.1, bad ? heading_rad : 0.0});
  }
  return errors;
}

TEST(JudgeLost, AGoodRunIsNotLost) {
  const LostVerdict verdict = judge_lost(bad_between(0, 0));
  EXPECT_FALSE(verdict.lost);
  EXPECT_FALSE(verdict.ends_lost);
  EXPECT_EQ(verdict.bad_share, 0.0);
}

TEST(JudgeLost, ARunThatEndsFarAwayIsLost) {
  EXPECT_TRUE(judge_lost(bad_between(94, 100)).ends_lost);
  EXPECT_TRUE(judge_lost(bad_between(97, 100)).ends_lost);  // 3 of the 6 samples within 5 s of the last
  EXPECT_FALSE(judge_lost(bad_between(98, 100)).lost);
}

TEST(JudgeLost, ARunThatIsFarAwayTooLongIsLostThoughItRecovers) {
  EXPECT_FALSE(judge_lost(bad_between(20, 30)).lost);  // 10 % is the limit itself
  const LostVerdict verdict = judge_lost(bad_between(20, 31));
  EXPECT_TRUE(verdict.lost);
  EXPECT_FALSE(verdict.ends_lost);
  EXPECT_NEAR(verdict.bad_share, 0.11, 1e-12);
}

TEST(JudgeLost, HeadingAloneIsEnough) {
  EXPECT_TRUE(judge_lost(bad_between(90, 100, 0.0, -0.8)).lost);
  EXPECT_FALSE(judge_lost(bad_between(90, 100, 0.0, -0.7)).lost);
}

TEST(JudgeLost, NoSamplesAreLost) { EXPECT_TRUE(judge_lost({}).lost); }

TEST(JudgeLost, RefusesLimitsOutOfRange) {
  EXPECT_THROW(judge_lost({}, {.position_m = 0.0}), ConfigurationError);
  EXPECT_THROW(judge_lost({}, {.heading_rad = -1.0}), ConfigurationError);
  EXPECT_THROW(judge_lost({}, {.final_window_s = -1.0}), ConfigurationError);
  EXPECT_THROW(judge_lost({}, {.max_bad_share = 1.5}), ConfigurationError);
}

}  // namespace
}  // namespace cairn
