#include "cairn/localization/scheduler.hpp"

#include "cairn/localization/cost_clock.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::milliseconds;
using Candidates = std::vector<Scheduler::Candidate>;

Time at(double s) { return time_from_seconds(s); }

SchedulerOptions options(const char* policy, double share = 0.0) {
  SchedulerOptions o;
  o.policy = policy;
  o.compute_share = share;
  return o;
}

Candidates waiting(std::initializer_list<StreamId> streams) {
  Candidates candidates;
  for (const StreamId stream : streams) candidates.push_back({stream, false});
  return candidates;
}

std::vector<bool> admitted(Scheduler& scheduler, std::initializer_list<StreamId> streams) {
  Candidates candidates = waiting(streams);
  scheduler.admit(candidates);
  std::vector<bool> result;
  for (const auto& c : candidates) result.push_back(c.admitted);
  return result;
}

TEST(Scheduler, WithoutALimitEverythingIsAdmitted) {
  for (const char* policy : {"all", "rate", "cfs"}) {
    Scheduler scheduler(options(policy), std::vector<Scheduler::Share>(2));
    scheduler.charge(0, std::chrono::hours(1));
    EXPECT_EQ(admitted(scheduler, {0, 1, 1, 0}), std::vector<bool>(4, true)) << policy;
  }
}

TEST(Scheduler, TheOldestFirstWithinTheCredit) {
  Scheduler scheduler(options("all", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.charge(0, milliseconds(40));  // 60 ms are left, and an update is known to cost 40
  EXPECT_EQ(admitted(scheduler, {0, 0, 0}), (std::vector<bool>{true, true, false}));
}

TEST(Scheduler, TheCreditGrowsWithTimeUpToThatOfOneSecond) {
  Scheduler scheduler(options("all", 0.5), std::vector<Scheduler::Share>(1));
  scheduler.advance(at(0));
  scheduler.charge(0, milliseconds(500));
  EXPECT_EQ(admitted(scheduler, {0}), std::vector<bool>{false});
  scheduler.advance(at(0.1));
  EXPECT_NEAR(scheduler.credit_s(), 0.05, 1e-12);
  EXPECT_EQ(admitted(scheduler, {0}), std::vector<bool>{true});
  scheduler.advance(at(100.0));
  EXPECT_NEAR(scheduler.credit_s(), 0.5, 1e-12);
  scheduler.advance(at(50.0));
  EXPECT_NEAR(scheduler.credit_s(), 0.5, 1e-12) << "back in time";
}

// Two streams that always have something waiting; returns how often each is served.
std::vector<int> contest(const std::vector<Scheduler::Share>& shares, const std::vector<int>& cost_ms) {
  Scheduler scheduler(options("cfs", 1.0), shares);
  std::vector<int> served(shares.size(), 0);
  for (int step = 0; step < 20000; ++step) {
    scheduler.advance(at(0.005 * step));
    Candidates candidates;
    for (std::size_t i = 0; i < shares.size(); ++i) candidates.push_back({static_cast<StreamId>(i), false});
    scheduler.admit(candidates);
    for (const auto& c : candidates) {
      if (!c.admitted) continue;
      ++served[c.stream];
      scheduler.charge(c.stream, milliseconds(cost_ms[c.stream]));
    }
  }
  return served;
}

TEST(Scheduler, CfsSharesTheTimeNotTheTurns) {
  const std::vector<int> served = contest({{}, {}}, {5, 50});
  EXPECT_NEAR(static_cast<double>(served[0]) / served[1], 10.0, 0.5);
  EXPECT_NEAR(5 * served[0] + 50 * served[1], 100'000, 2'000) << "100 s at one second per second";
}

TEST(Scheduler, NiceChangesTheShares) {
  const std::vector<int> served = contest({{1.0, {}}, {3.0, {}}}, {10, 10});
  EXPECT_NEAR(static_cast<double>(served[0]) / served[1], 3.0, 0.15);
}

TEST(Scheduler, CfsTakesTheNewestOfAStream) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.charge(0, milliseconds(40));  // 60 ms are left: enough for one more
  EXPECT_EQ(admitted(scheduler, {0, 0, 0}), (std::vector<bool>{false, false, true}));
}

TEST(Scheduler, CfsMakesNoDebts) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(2));
  scheduler.charge(0, milliseconds(1));
  scheduler.charge(1, milliseconds(60));  // 39 ms are left
  EXPECT_EQ(admitted(scheduler, {1, 0}), (std::vector<bool>{false, true})) << "the cheap one need not wait";
  scheduler.advance(at(0));
  scheduler.advance(at(0.22));
  EXPECT_EQ(admitted(scheduler, {1}), std::vector<bool>{true}) << "saved up";
}

TEST(Scheduler, WhatCostsMoreThanCanBeSavedIsMadeWithAllThatCan) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.charge(0, milliseconds(250));
  scheduler.advance(at(0));
  scheduler.advance(at(1.0));
  scheduler.advance(at(2.0));
  EXPECT_EQ(admitted(scheduler, {0}), std::vector<bool>{false});
  scheduler.advance(at(3.0));
  EXPECT_EQ(admitted(scheduler, {0}), std::vector<bool>{true});
}

TEST(Scheduler, WhileOneSavesUpTheOthersGoOnAsFarAsIfItHadBeenServed) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(2));
  admitted(scheduler, {0, 1});
  scheduler.charge(1, milliseconds(30));
  for (int i = 0; i < 5; ++i) scheduler.charge(0, milliseconds(9));
  EXPECT_EQ(admitted(scheduler, {0, 0, 0, 1}), (std::vector<bool>{false, true, true, false}))
      << "25 ms are left, and its 30 would bring the dear one to 60";
  for (int i = 0; i < 2; ++i) scheduler.charge(0, milliseconds(9));
  scheduler.advance(at(0));
  scheduler.advance(at(0.2));
  EXPECT_EQ(admitted(scheduler, {0, 1}), (std::vector<bool>{false, false})) << "now it is its turn";
  scheduler.advance(at(0.31));
  EXPECT_EQ(admitted(scheduler, {0, 1}), (std::vector<bool>{false, true}));
}

Candidates late(std::initializer_list<double> redo_s) {
  Candidates candidates;
  for (const double s : redo_s) candidates.push_back({0, false, s});
  return candidates;
}

TEST(Scheduler, LateOnesGoBackTogether) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.charge(0, milliseconds(10));
  scheduler.charge(0, milliseconds(50));
  const double cost_s = 0.018;  // 0.8 * 10 + 0.2 * 50 ms; 40 ms are left
  Candidates together = late({0.012, 0.004});
  scheduler.admit(together);
  EXPECT_FALSE(together[0].admitted || together[1].admitted) << 2 * cost_s + 0.012 << " is saved up for,";
  scheduler.advance(at(0));
  scheduler.advance(at(0.085));
  scheduler.admit(together);
  EXPECT_TRUE(together[0].admitted && together[1].admitted) << "not spent on the later one alone";
}

TEST(Scheduler, WhereAllLateOnesAskForTooMuchTheNewestGoes) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.charge(0, milliseconds(10));
  Candidates candidates = late({0.085, 0.05});
  scheduler.admit(candidates);
  EXPECT_FALSE(candidates[0].admitted);
  EXPECT_TRUE(candidates[1].admitted);
}

TEST(Scheduler, WhatRidesIsOnlyPutInWhereTheBeliefGoesBackAnyhow) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(2));
  scheduler.charge(0, milliseconds(10));
  scheduler.charge(1, milliseconds(50));  // 40 ms are left
  Candidates alone{{0, false, 0.02, 0.0, true}};
  scheduler.admit(alone);
  EXPECT_FALSE(alone[0].admitted) << "doing 20 ms again for one of 10";
  Candidates cheap{{0, false, 0.005, 0.0, true}};
  scheduler.admit(cheap);
  EXPECT_TRUE(cheap[0].admitted);
  Scheduler other(options("cfs", 0.1), std::vector<Scheduler::Share>(2));
  other.charge(0, milliseconds(10));
  other.charge(1, milliseconds(5));
  other.charge_redo(0, milliseconds(40));  // 45 ms are left
  Candidates with_another{{1, false, 0.022, 0.0, false}, {0, false, 0.02, 0.0, true}};
  other.admit(with_another);
  EXPECT_TRUE(with_another[0].admitted && with_another[1].admitted) << "5 + 22 + 10";
}

TEST(Scheduler, WhatIsDoneAgainIsPaidByWhoCameLate) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(2));
  scheduler.charge(0, milliseconds(10));
  scheduler.charge_redo(0, milliseconds(30));
  EXPECT_NEAR(scheduler.virtual_time_s(0), 0.04, 1e-12);
  EXPECT_NEAR(scheduler.credit_s(), 0.06, 1e-12);
  EXPECT_EQ(admitted(scheduler, {0, 0, 0, 0, 0, 0}), std::vector<bool>(6, true)) << "an update costs 10 ms";
}

TEST(Scheduler, TheDearWaitUntilTheyNeedNotBeDoneAgain) {
  Scheduler scheduler(options("cfs", 0.1), std::vector<Scheduler::Share>(1));
  scheduler.advance(at(0));
  for (int i = 0; i < 2; ++i) scheduler.charge(0, milliseconds(30));
  Candidates thrice{{0, false, 0.0, 3.0}}, never{{0, false, 0.0, 0.0}};
  scheduler.admit(thrice);
  EXPECT_TRUE(thrice[0].admitted) << "90 ms are more than can be saved for that, but all of it is there";
  scheduler.charge(0, milliseconds(30));
  scheduler.advance(at(0.35));
  thrice[0].admitted = false;
  scheduler.admit(thrice);
  EXPECT_FALSE(thrice[0].admitted);
  scheduler.admit(never);
  EXPECT_TRUE(never[0].admitted) << "45 ms are there";
}

TEST(Scheduler, AStreamThatSleptCannotSaveUpTime) {
  Scheduler scheduler(options("cfs", 1.0), std::vector<Scheduler::Share>(2));
  for (int i = 0; i < 100; ++i) {
    scheduler.advance(at(i));
    ASSERT_EQ(admitted(scheduler, {0}), std::vector<bool>{true});
    scheduler.charge(0, milliseconds(400));
  }
  admitted(scheduler, {0, 1});
  EXPECT_GE(scheduler.virtual_time_s(1), scheduler.virtual_time_s(0) - 0.401);
}

TEST(Scheduler, RateLooksAtTheStamps) {
  Scheduler scheduler(options("rate"), {{}, {1.0, 1.0}});
  EXPECT_TRUE(scheduler.due(0, std::nullopt, at(3.0)));
  EXPECT_TRUE(scheduler.due(0, at(3.0), at(3.2)));
  EXPECT_FALSE(scheduler.due(0, at(3.0), at(3.19)));
  EXPECT_FALSE(scheduler.due(1, at(3.0), at(3.9))) << "its own rate";
  EXPECT_TRUE(Scheduler(options("all"), {{}}).due(0, at(3.0), at(3.0)));
}

TEST(CostClock, TheModelledCostIsAProduct) {
  ModelledCost clock(10.0);
  clock.start();
  EXPECT_EQ(clock.stop({.beams = 60, .particles = 500}), std::chrono::microseconds(300));
  EXPECT_GT(ModelledCost(1e9).stop({.beams = 1'000'000, .particles = 10'000'000}).count(), 0)
      << "no overflow";
}

TEST(CostClock, TheWallClockRunsForward) {
  WallClockCost clock;
  clock.start();
  EXPECT_GE(clock.stop({}).count(), 0);
}

}  // namespace
}  // namespace cairn
