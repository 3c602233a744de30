#include "cairn/core/time.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Time at(std::int64_t nanoseconds) { return Time(Duration(nanoseconds)); }

TEST(ParseTime, IsExact) {
  EXPECT_EQ(parse_time("976052857.337530"), at(976052857337530000));
  EXPECT_EQ(parse_time("1234567890.123456789"), at(1234567890123456789));  // a double ends at 0.1 us here
  EXPECT_EQ(parse_time("0.000000001"), at(1));
  EXPECT_EQ(parse_time("12"), at(12'000'000'000));
  EXPECT_EQ(parse_time(".5"), at(500'000'000));
  EXPECT_EQ(parse_time("5."), at(5'000'000'000));
  EXPECT_EQ(parse_time("007.10"), at(7'100'000'000));
}

TEST(ParseTime, TakesSigns) {
  EXPECT_EQ(parse_time("-1.25"), at(-1'250'000'000));
  EXPECT_EQ(parse_time("-0.5"), at(-500'000'000));
  EXPECT_EQ(parse_time("+2"), at(2'000'000'000));
}

TEST(ParseTime, CutsDigitsBeyondNanoseconds) {
  EXPECT_EQ(parse_time("1.0000000019999"), at(1'000'000'001));
  EXPECT_EQ(parse_time("-1.0000000019999"), at(-1'000'000'001));
}

TEST(ParseTime, RefusesGarbage) {
  for (const char* text : {"",     ".",     "-",    "+",    "-.",  "--1",  "+-1",           "1-",  "1.2.3",
                           "1e5",  "1.5e3", " 1",   "1 ",   "1,5", "0x10", "nan",           "inf", "1.-5",
                           "1.+5", "abc",   "1.2x", "1.x2", "1\n", "١",    "1.12345678901x"}) {
    EXPECT_EQ(parse_time(text), std::nullopt) << "'" << text << "'";
  }
}

TEST(ParseTime, EndsAt292Years) {
  EXPECT_EQ(parse_time("9200000000"), at(9'200'000'000'000'000'000));
  EXPECT_EQ(parse_time("-9200000000.999999999"), at(-9'200'000'000'999'999'999));
  EXPECT_EQ(parse_time("9200000001"), std::nullopt);
  EXPECT_EQ(parse_time("-9223372036854775808"), std::nullopt);
  EXPECT_EQ(parse_time("99999999999999999999999999"), std::nullopt);
}

TEST(FormatTime, HasNineDecimalsAndASign) {
  EXPECT_EQ(format_time(at(0)), "0.000000000");
  EXPECT_EQ(format_time(at(1)), "0.000000001");
  EXPECT_EQ(format_time(at(-1)), "-0.000000001");
  EXPECT_EQ(format_time(at(976052857337530000)), "976052857.337530000");
  EXPECT_EQ(format_time(at(std::numeric_limits<std::int64_t>::min())), "-9223372036.854775808");
}

TEST(FormatTime, IsTheInverseOfParseTime) {
  for (const std::int64_t n : {0LL, 1LL, -1LL, 999'999'999LL, -1'000'000'000LL, 1234567890123456789LL,
                               -9'200'000'000'999'999'999LL}) {
    EXPECT_EQ(parse_time(format_time(at(n))), at(n)) << n;
  }
}

TEST(Seconds, RoundToTheNearestNanosecond) {
  EXPECT_EQ(duration_from_seconds(0.1), Duration(100'000'000));
  EXPECT_EQ(duration_from_seconds(-0.1), Duration(-100'000'000));
  EXPECT_EQ(duration_from_seconds(-2.0), Duration(-2'000'000'000));
  EXPECT_EQ(duration_from_seconds(1.4e-9), Duration(1));
  EXPECT_EQ(duration_from_seconds(1.6e-9), Duration(2));
  EXPECT_EQ(duration_from_seconds(0.9999999999), Duration(1'000'000'000));
  EXPECT_EQ(time_from_seconds(9.2e9), at(9'200'000'000'000'000'000));
}

TEST(Seconds, LargeEpochsKeepTheirFraction) {
  const double seconds = 1234567890.25;
  EXPECT_EQ(time_from_seconds(seconds), at(1234567890250000000));
  EXPECT_DOUBLE_EQ(to_seconds(time_from_seconds(seconds)), seconds);
  EXPECT_DOUBLE_EQ(to_seconds(Duration(-1'500'000'000)), -1.5);
}

}  // namespace
}  // namespace cairn
