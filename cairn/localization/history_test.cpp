#include "cairn/localization/history.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::seconds;

Time at(double s) { return time_from_seconds(s); }

Measurement measurement(double s, StreamId stream = 0) {
  Measurement m;
  m.event.stamp = at(s);
  m.event.stream = stream;
  return m;
}

// A belief that remembers exactly what was done to it, in which order.
struct Recollection {
  using Checkpoint = std::vector<TimelineKey>;
  void save(Checkpoint& checkpoint) const { checkpoint = applied; }
  void restore(const Checkpoint& checkpoint) { applied = checkpoint; }
  std::vector<TimelineKey> applied;
};

class HistoryTest : public ::testing::Test {
 protected:
  void catch_up() {
    depth_ = history_.catch_up(belief_, [&](History<Recollection>::Entry& entry, bool again) {
      belief_.applied.push_back(key_of(entry.measurement));
      entry.outcome = entry.late ? Outcome::kReplayed : Outcome::kUsed;
      entry.cost = seconds(1 + key_of(entry.measurement).stream);
      (again ? again_ : first_) += 1;
      if (again) cost_again_ += entry.cost;
    });
    history_.forget_before(history_.wanted_from());
  }

  bool arrive(const Measurement& m) {
    if (history_.is_stale(m.event.stamp) || history_.contains(key_of(m))) return false;
    history_.insert(m);
    catch_up();
    return true;
  }

  History<Recollection> history_{seconds(2)};
  Recollection belief_;
  int first_ = 0, again_ = 0;
  Duration depth_{0}, cost_again_{0};
};

TEST_F(HistoryTest, InOrderNothingIsDoneTwice) {
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(arrive(measurement(0.1 * i)));
  EXPECT_EQ(belief_.applied.size(), 100U);
  EXPECT_EQ(again_, 0);
  EXPECT_EQ(history_.rewinds(), 0);
}

TEST_F(HistoryTest, PutsALateOneAtItsTrueTime) {
  for (const double t : {0.0, 1.0, 2.0}) arrive(measurement(t));
  EXPECT_TRUE(arrive(measurement(1.5)));
  const std::vector<TimelineKey> expected{{at(0), 0}, {at(1), 0}, {at(1.5), 0}, {at(2), 0}};
  EXPECT_EQ(belief_.applied, expected);
  EXPECT_EQ(history_.entries()[2].outcome, Outcome::kReplayed);
  EXPECT_EQ(history_.entries()[3].outcome, Outcome::kUsed) << "in time, but applied again";
  EXPECT_EQ(first_, 4);
  EXPECT_GE(again_, 1);
}

TEST_F(HistoryTest, KnowsWhatItWouldCostToGoBack) {
  EXPECT_EQ(history_.redo_cost({at(0), 0}), seconds(0));
  for (int i = 0; i <= 10; ++i) arrive(measurement(0.1 * i, static_cast<StreamId>(i % 2)));
  EXPECT_EQ(history_.redo_cost({at(1.05), 0}), seconds(0)) << "nothing is later";
  const auto before = history_.rewinds();
  for (const double t : {0.95, 0.55, 0.02, 0.33}) {
    const Duration price = history_.redo_cost({at(t), 7});
    cost_again_ = seconds(0);
    arrive(measurement(t, 7));
    EXPECT_EQ(price, cost_again_) << t;
  }
  EXPECT_EQ(history_.rewinds(), before + 4);
}

TEST_F(HistoryTest, TellsHowFarItWentBack) {
  for (int i = 0; i <= 10; ++i) arrive(measurement(0.1 * i));
  EXPECT_EQ(depth_, seconds(0));
  arrive(measurement(0.55));
  EXPECT_GE(depth_, std::chrono::milliseconds(450));
  EXPECT_LE(depth_, std::chrono::milliseconds(650));
}

TEST_F(HistoryTest, TheNextLateOneOfAStreamFindsACheckpointRightBeforeIt) {
  for (int i = 0; i <= 200; ++i) {
    arrive(measurement(0.01 * i));
    if (i % 10 != 7 || i < 60) continue;
    again_ = 0;
    arrive(measurement(0.01 * i - 0.505, 1));
    if (i == 67) continue;  // the first finds none
    EXPECT_LE(again_, 61) << "51 came after it, 9 between it and the late one before it";
  }
}

TEST_F(HistoryTest, OfOneStampTheLowerStreamComesFirst) {
  arrive(measurement(1.0, 2));
  arrive(measurement(1.0, 1));
  const std::vector<TimelineKey> expected{{at(1), 1}, {at(1), 2}};
  EXPECT_EQ(belief_.applied, expected);
}

TEST_F(HistoryTest, KnowsWhatItHas) {
  arrive(measurement(1.0, 1));
  EXPECT_TRUE(history_.contains({at(1), 1}));
  EXPECT_FALSE(history_.contains({at(1), 0}));
  EXPECT_FALSE(history_.contains({at(1.1), 1}));
}

TEST_F(HistoryTest, DoesAgainWhatDependsOnSomethingThatChanged) {
  for (int i = 0; i <= 10; ++i) arrive(measurement(0.1 * i));
  history_.redo_after(at(0.75));
  catch_up();
  EXPECT_EQ(belief_.applied.size(), 11U);
  EXPECT_GE(again_, 3);
  EXPECT_LE(again_, 5) << "from the checkpoint before it, not from the beginning";
  history_.redo_after(at(1.0));
  catch_up();
  EXPECT_EQ(history_.rewinds(), 1) << "nothing is later than 1.0";
}

TEST_F(HistoryTest, RefusesWhatIsOlderThanItReaches) {
  for (int i = 0; i <= 100; ++i) arrive(measurement(0.1 * i));
  EXPECT_TRUE(history_.is_stale(at(7.9)));
  EXPECT_FALSE(history_.is_stale(at(8.0)));
  EXPECT_FALSE(arrive(measurement(7.9)));
  EXPECT_TRUE(arrive(measurement(8.05)));
  EXPECT_TRUE(std::is_sorted(belief_.applied.begin(), belief_.applied.end()));
}

TEST_F(HistoryTest, StaysBounded) {
  for (int i = 0; i < 20'000; ++i) {
    arrive(measurement(0.01 * i));
    ASSERT_LE(history_.checkpoints(), History<Recollection>::kCheckpoints);
    ASSERT_LE(history_.entries().size(), 240U);
    if (belief_.applied.size() > 1000) belief_.applied.clear();
  }
  for (int i = 0; i < 10'000; ++i) arrive(measurement(200.0 + 1e-5 * i));
  EXPECT_LE(history_.entries().size(), History<Recollection>::kMostEntries + 1);
}

TEST_F(HistoryTest, WithoutASpanNothingIsDoneAgain) {
  history_ = History<Recollection>(seconds(0));
  arrive(measurement(1.0, 2));
  EXPECT_TRUE(arrive(measurement(1.0, 1))) << "of the same instant";
  EXPECT_FALSE(arrive(measurement(0.9)));
  EXPECT_FALSE(arrive(measurement(1.0, 1)));
  EXPECT_TRUE(arrive(measurement(1.1)));
  history_.redo_after(at(0));
  catch_up();
  EXPECT_EQ(again_, 0);
  EXPECT_EQ(history_.checkpoints(), 0U);
}

TEST_F(HistoryTest, AnyOrderOfArrivalWithinTheHistoryGivesTheSortedOrder) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    history_ = History<Recollection>(seconds(2));
    belief_ = {};
    unsigned dice = seed;
    const auto roll = [&] { return (dice = dice * 1664525U + 1013904223U) >> 8; };
    std::vector<std::pair<double, Measurement>> arrivals;
    for (int i = 0; i < 150; ++i) {
      const double delay = static_cast<double>(roll() % 1900) * 1e-3;
      arrivals.emplace_back(0.05 * i + delay, measurement(0.05 * i, static_cast<StreamId>(roll() % 3)));
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [when, m] : arrivals) {
      ASSERT_TRUE(arrive(m)) << seed;
      if (roll() % 4 == 0) history_.redo_after(m.event.stamp - std::chrono::milliseconds(roll() % 500));
    }
    catch_up();
    ASSERT_EQ(belief_.applied.size(), 150U) << seed;
    ASSERT_TRUE(std::is_sorted(belief_.applied.begin(), belief_.applied.end())) << seed;
  }
}

TEST_F(HistoryTest, StartsAnew) {
  for (int i = 0; i <= 100; ++i) arrive(measurement(0.1 * i));
  history_.restart();
  EXPECT_TRUE(arrive(measurement(1.0)));
}

}  // namespace
}  // namespace cairn
