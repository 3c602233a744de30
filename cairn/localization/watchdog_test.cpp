#include "cairn/localization/watchdog.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::milliseconds;

Time at(double s) { return time_from_seconds(s); }

std::vector<StreamId> silent(Watchdog& dog, double now_s) {
  std::vector<StreamId> found;
  dog.look(at(now_s), [&](StreamId stream, Time, Duration) { found.push_back(stream); });
  return found;
}

TEST(Watchdog, NamesASilentStreamOnce) {
  Watchdog dog({std::nullopt, std::nullopt}, 5.0);
  for (int i = 0; i <= 20; ++i) {
    dog.heard(0, at(0.1 * i));
    dog.heard(1, at(0.1 * i));
  }
  for (int i = 21; i <= 24; ++i) {
    dog.heard(1, at(0.1 * i));
    EXPECT_TRUE(silent(dog, 0.1 * i).empty()) << i;
  }
  dog.heard(1, at(2.51));
  EXPECT_EQ(silent(dog, 2.51), std::vector<StreamId>{0});
  EXPECT_TRUE(dog.is_silent(0));
  EXPECT_TRUE(silent(dog, 2.52).empty()) << "once";
  EXPECT_EQ(silent(dog, 9.0), std::vector<StreamId>{1});
}

TEST(Watchdog, NamesItAgainAfterItCameBack) {
  Watchdog dog({std::nullopt}, 3.0);
  for (int i = 0; i < 10; ++i) dog.heard(0, at(i));
  EXPECT_EQ(silent(dog, 12.5).size(), 1U);
  dog.heard(0, at(20.0));
  EXPECT_FALSE(dog.is_silent(0));
  EXPECT_TRUE(silent(dog, 22.9).empty()) << "the silence itself did not change the period";
  EXPECT_EQ(silent(dog, 23.1).size(), 1U);
}

TEST(Watchdog, TakesThePeriodThatIsTold) {
  Watchdog dog({Duration(milliseconds(100))}, 4.0);
  dog.heard(0, at(0.0));
  EXPECT_TRUE(silent(dog, 0.39).empty());
  EXPECT_EQ(silent(dog, 0.41).size(), 1U);
}

TEST(Watchdog, DoesNotComplainOfOneMessageOrWhenSwitchedOff) {
  Watchdog once({std::nullopt}, 3.0);
  once.heard(0, at(0.0));
  EXPECT_TRUE(silent(once, 1e6).empty()) << "no period is known";
  Watchdog off({Duration(milliseconds(100))}, 0.0);
  off.heard(0, at(0.0));
  EXPECT_TRUE(silent(off, 1e6).empty());
}

TEST(Watchdog, ABurstIsNoPeriod) {
  Watchdog dog({std::nullopt}, 3.0);
  for (int i = 0; i < 10; ++i) dog.heard(0, at(1.0));
  EXPECT_TRUE(silent(dog, 1e6).empty()) << "all arrived at one instant";
}

TEST(Watchdog, BurstsAreARhythm) {
  Watchdog dog({std::nullopt}, 5.0);
  for (int burst = 0; burst < 40; ++burst) {
    for (int i = 0; i < 4; ++i) {
      const double now = 0.5 * burst + 0.001 * i;
      if (burst > 10) {
        EXPECT_TRUE(silent(dog, now).empty()) << now;
      }
      dog.heard(0, at(now));
    }
  }
  EXPECT_EQ(silent(dog, 19.503 + 5.0 * 0.5).size(), 1U);
}

TEST(Watchdog, StartsAnewWithTheClock) {
  Watchdog dog({std::nullopt}, 3.0);
  for (int i = 0; i < 10; ++i) dog.heard(0, at(1000 + i));
  dog.restart(at(5));
  EXPECT_TRUE(silent(dog, 7.9).empty());
  EXPECT_EQ(silent(dog, 8.1).size(), 1U);
}

}  // namespace
}  // namespace cairn
