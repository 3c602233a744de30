#include "cairn/localization/rewind_forecast.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::milliseconds;

Time at(double s) { return time_from_seconds(s); }

TEST(RewindForecast, NothingIsDoneAgainWhereTheBeliefNeverWentBack) {
  EXPECT_EQ(RewindForecast().redos(milliseconds(0), at(1)), 0.0);
}

TEST(RewindForecast, WhatIsNewIsDoneAgainByEveryRewindUntilItIsTooOld) {
  RewindForecast forecast;
  for (int i = 0; i < 10; ++i) forecast.went_back(milliseconds(500), at(8.1 + 0.2 * i));
  EXPECT_NEAR(forecast.redos(milliseconds(0), at(10)), 2.5, 1e-9) << "5 per second, for half a second";
  EXPECT_NEAR(forecast.redos(milliseconds(-100), at(10)), 2.5, 1e-9);
  EXPECT_NEAR(forecast.redos(milliseconds(300), at(10)), 1.0, 1e-9);
  EXPECT_EQ(forecast.redos(milliseconds(500), at(10)), 0.0);
}

TEST(RewindForecast, ForgetsWhatWasLongAgo) {
  RewindForecast forecast;
  forecast.went_back(milliseconds(1000), at(5));
  EXPECT_NEAR(forecast.redos(milliseconds(0), at(6.9)), 0.5, 1e-9);
  EXPECT_EQ(forecast.redos(milliseconds(0), at(7.1)), 0.0);
  forecast.went_back(milliseconds(1000), at(8));
  forecast.clear();
  EXPECT_EQ(forecast.redos(milliseconds(0), at(8)), 0.0);
}

TEST(RewindForecast, ManyRewindsCountInTheShorterTimeThatThereIsRoomFor) {
  RewindForecast forecast;
  for (int i = 0; i < 1000; ++i) forecast.went_back(milliseconds(100), at(0.01 * i));
  EXPECT_NEAR(forecast.redos(milliseconds(0), at(9.99)), 10.0, 0.3) << "100 per second, for a tenth of one";
}

}  // namespace
}  // namespace cairn
