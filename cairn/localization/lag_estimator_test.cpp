#include "cairn/localization/lag_estimator.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Time at(double s) { return time_from_seconds(s); }

// A message every 0.1 s for `n` messages from `from_s`, each `lag` behind.
double speak(LagEstimator& lags, StreamId stream, double from_s, int n, milliseconds lag) {
  for (int i = 0; i < n; ++i, from_s += 0.1) {
    lags.observe(stream, at(from_s) - lag, at(from_s), at(from_s));
  }
  return from_s;
}

TEST(LagEstimator, MeasuresEachStream) {
  LagEstimator lags(3, seconds(10));
  const double now = speak(lags, 0, 0.0, 20, milliseconds(5));
  speak(lags, 1, 0.0, 20, milliseconds(300));
  EXPECT_EQ(lags.typical(0, at(now)), milliseconds(5));
  EXPECT_EQ(lags.typical(1, at(now)), milliseconds(300));
  EXPECT_FALSE(lags.typical(2, at(now)));
  EXPECT_EQ(lags.shortest(at(now)), milliseconds(5));
  EXPECT_EQ(lags.longest(at(now)), milliseconds(300));
}

TEST(LagEstimator, AFewWildStampsChangeNothing) {
  LagEstimator lags(1, seconds(100));
  double now = speak(lags, 0, 0.0, 30, milliseconds(50));
  lags.observe(0, at(-1e6), at(now), at(now));
  EXPECT_EQ(lags.longest(at(now)), milliseconds(50)) << "one of 31 is within the 5 % that are left out";
  for (int i = 0; i < 10; ++i) lags.observe(0, at(1e6), at(now), at(now));
  EXPECT_EQ(lags.typical(0, at(now)), milliseconds(50));
}

TEST(LagEstimator, FollowsALagThatChanges) {
  LagEstimator lags(1, seconds(100));
  const double changed = speak(lags, 0, 0.0, 50, milliseconds(400));
  const double now = speak(lags, 0, changed, 16, milliseconds(20));
  EXPECT_EQ(lags.typical(0, at(now)), milliseconds(20));
  EXPECT_EQ(lags.longest(at(now)), milliseconds(400)) << "as long as some of the last messages came so late";
  EXPECT_EQ(lags.longest(at(speak(lags, 0, now, 15, milliseconds(20)))), milliseconds(20));
}

TEST(LagEstimator, ForgetsASilentStream) {
  LagEstimator lags(2, seconds(2));
  speak(lags, 1, 0.0, 20, milliseconds(900));
  const double now = speak(lags, 0, 2.0, 21, milliseconds(10));
  EXPECT_EQ(lags.longest(at(now)), milliseconds(10));
}

TEST(LagEstimator, KnowsNothingAtTheBeginning) {
  const LagEstimator lags(2, seconds(2));
  EXPECT_FALSE(lags.shortest(at(0)));
  EXPECT_FALSE(lags.longest(at(0)));
}

}  // namespace
}  // namespace cairn
