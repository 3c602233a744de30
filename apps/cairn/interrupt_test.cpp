#include "apps/cairn/interrupt.hpp"

#include <csignal>

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

TEST(InterruptGuard, NoticesBothSignals) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptGuard guard;
    EXPECT_FALSE(guard.requested()) << "an earlier request is forgotten";
    std::raise(signal);
    EXPECT_TRUE(guard.requested());
  }
}

TEST(InterruptGuardDeathTest, ASecondSignalKills) {
  const auto ask_twice = [] {
    const InterruptGuard guard;
    std::raise(SIGINT);
    std::raise(SIGINT);
  };
  EXPECT_EXIT(ask_twice(), ::testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptGuardDeathTest, SignalsKillAgainWhenItIsGone) {
  const auto ask_after = [] {
    { const InterruptGuard guard; }
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(ask_after(), ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace cairn::app
