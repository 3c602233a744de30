#include "apps/cairn/time_spans.hpp"

#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

TEST(TimeSpans, ContainTheirStartsAndNotTheirEnds) {
  const TimeSpans spans("--spans", "0-10,20.5-30");
  for (const double s : {0.0, 9.9, 20.5, 29.9}) EXPECT_TRUE(spans.contains(duration_from_seconds(s))) << s;
  for (const double s : {10.0, 15.0, 20.4, 30.0, 1e6})
    EXPECT_FALSE(spans.contains(duration_from_seconds(s))) << s;
}

TEST(TimeSpans, NoneIsEverything) {
  EXPECT_TRUE(TimeSpans("--spans", "").everything());
  EXPECT_TRUE(TimeSpans("--spans", "").contains(duration_from_seconds(1e9)));
}

TEST(TimeSpans, RefuseWhatIsNone) {
  for (const char* bad : {"5", "-5", "5-", "9-5", "a-b", "1-2,,3-4", "nan-nan", "0-inf", "1-1", "0-1e300"}) {
    EXPECT_THROW(TimeSpans("--spans", bad), ConfigurationError) << bad;
  }
}

}  // namespace
}  // namespace cairn::app
