#include "cairn/localization/accounts.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::int64_t count(const Accounts& accounts, StreamId stream, Outcome outcome) {
  return accounts.table()[stream][static_cast<std::size_t>(outcome)];
}

TEST(Accounts, EveryMessageStandsUnderOneOutcome) {
  Accounts accounts(2);
  accounts.open(1, Outcome::kPending);
  accounts.open(1, Outcome::kUsed);
  accounts.move(1, Outcome::kPending, Outcome::kReplayed);
  accounts.move(1, Outcome::kUsed, Outcome::kNotNeeded);
  EXPECT_EQ(count(accounts, 1, Outcome::kPending), 0);
  EXPECT_EQ(count(accounts, 1, Outcome::kReplayed), 1);
  EXPECT_EQ(count(accounts, 1, Outcome::kNotNeeded), 1);
  EXPECT_EQ(accounts.table()[0], OutcomeCounts{});
}

TEST(Outcome, EveryOneHasANameAndAKind) {
  int uses = 0, drops = 0;
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    EXPECT_STRNE(to_string(outcome), "unknown");
    EXPECT_EQ(is_drop(outcome), std::string(to_string(outcome)).starts_with("dropped_")) << i;
    EXPECT_FALSE(is_use(outcome) && is_drop(outcome));
    uses += is_use(outcome) ? 1 : 0;
    drops += is_drop(outcome) ? 1 : 0;
  }
  EXPECT_EQ(uses, 3);
  EXPECT_EQ(drops, 7);
}

TEST(Outcome, TheDropRateIsDroppedOverReceived) {
  OutcomeCounts counts{};
  EXPECT_EQ(drop_rate(counts), 0.0);
  counts[static_cast<std::size_t>(Outcome::kUsed)] = 5;
  counts[static_cast<std::size_t>(Outcome::kNotNeeded)] = 2;
  counts[static_cast<std::size_t>(Outcome::kDroppedStale)] = 2;
  counts[static_cast<std::size_t>(Outcome::kDroppedMalformed)] = 1;
  EXPECT_DOUBLE_EQ(drop_rate(counts), 0.3) << "what was not needed is not lost";
}

}  // namespace
}  // namespace cairn
