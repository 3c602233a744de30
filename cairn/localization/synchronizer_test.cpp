#include "cairn/localization/synchronizer.hpp"

#include "small_room.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;

TimeOptions policy(const char* late_policy) {
  TimeOptions options;
  options.late_policy = late_policy;
  return options;
}

// Streams: 0 is the odometry, 1 and 2 are sensors.
class SynchronizerTest : public ::testing::Test {
 protected:
  void odometry(double stamp, double lag = 0.0) {
    const Event event = test::odometry_event(stamp, {stamp, 0, 0});
    now_ = std::max(now_, stamp + lag);
    synchronizer_.observe({event.stamp, at(stamp + lag), 0, event.payload}, at(now_));
    synchronizer_.add(std::get<Odometry>(event.payload), at(now_));
  }
  void measure(double stamp, StreamId stream = 1, double lag = 0.0) {
    Measurement m;
    m.event.stamp = at(stamp);
    m.event.arrival = at(stamp + lag);
    m.event.stream = stream;
    now_ = std::max(now_, stamp + lag);
    synchronizer_.observe(m.event, at(now_));
    synchronizer_.add(std::move(m));
  }
  static std::vector<Time> times(std::initializer_list<double> seconds) {
    std::vector<Time> times;
    for (const double s : seconds) times.push_back(at(s));
    return times;
  }
  std::vector<Time> waiting() const {
    std::vector<Time> stamps;
    for (const Measurement& m : synchronizer_.waiting()) stamps.push_back(m.event.stamp);
    return stamps;
  }

  Synchronizer synchronizer_{policy("replay"), 3};
  double now_ = 0.0;
};

TEST_F(SynchronizerTest, PutsWhatArrivesIntoTheOrderOfItsStamps) {
  for (const double t : {3.0, 1.0, 2.0}) measure(t);
  EXPECT_EQ(waiting(), times({1.0, 2.0, 3.0}));
  EXPECT_TRUE(synchronizer_.waits({at(2.0), 1}));
  EXPECT_FALSE(synchronizer_.waits({at(2.0), 2}));
}

TEST_F(SynchronizerTest, AMeasurementWaitsForTheOdometryAroundIt) {
  odometry(0.0);
  measure(0.05);
  measure(0.15);
  EXPECT_EQ(synchronizer_.ready(), 0U);
  odometry(0.1);
  EXPECT_EQ(synchronizer_.ready(), 1U);
  odometry(0.2);
  EXPECT_EQ(synchronizer_.ready(), 2U);
}

TEST_F(SynchronizerTest, HandsOutWhatIsAdmittedAndMarksTheRest) {
  odometry(0.0);
  for (const double t : {0.1, 0.2, 0.3, 0.9}) measure(t);
  odometry(0.5);
  std::vector<Scheduler::Candidate> choice{{1, true}, {1, false}, {1, true}};
  std::vector<Time> used;
  synchronizer_.take(choice, [&](Measurement&& m) { used.push_back(m.event.stamp); });
  EXPECT_EQ(used, times({0.1, 0.3}));
  EXPECT_EQ(waiting(), times({0.2, 0.9}));
  EXPECT_TRUE(synchronizer_.waiting()[0].deferred);
  EXPECT_FALSE(synchronizer_.waiting()[1].deferred) << "its turn has not come";
}

TEST_F(SynchronizerTest, GoesOnWithoutOdometryThatFellSilent) {
  odometry(0.0);
  for (int i = 1; i <= 10; ++i) measure(0.1 * i);
  EXPECT_EQ(synchronizer_.ready(), 0U) << "one second of patience";
  measure(1.1);
  EXPECT_EQ(synchronizer_.ready(), 11U);
}

TEST_F(SynchronizerTest, AStampFromTheFutureWaitsUntilItsTime) {
  odometry(0.0);
  for (int i = 1; i <= 20; ++i) measure(0.1 * i);
  measure(5.0, 2, -3.0);  // arrives at 2.0
  EXPECT_EQ(synchronizer_.ready(), 20U);
  for (int i = 21; i <= 49; ++i) measure(0.1 * i);
  EXPECT_EQ(synchronizer_.ready(), 49U);
  measure(5.1);
  EXPECT_EQ(synchronizer_.ready(), 51U);
}

TEST_F(SynchronizerTest, OneWrongArrivalIsNoSilence) {
  odometry(0.0);
  measure(100.0);
  EXPECT_EQ(synchronizer_.ready(), 0U);
  odometry(0.1);
  for (int i = 1; i < 10; ++i) measure(0.1 * i + 0.05);
  EXPECT_EQ(synchronizer_.ready(), 0U) << "the odometry was heard after that";
}

TEST_F(SynchronizerTest, DelayWaitsForTheMostDelayedStream) {
  synchronizer_ = Synchronizer(policy("delay"), 3);
  for (int i = 0; i <= 40; ++i) {
    odometry(0.1 * i);
    measure(0.1 * i, 1);
    if (i >= 5) measure(0.1 * i - 0.5, 2, 0.5);
  }
  const std::size_t ready = synchronizer_.ready();
  EXPECT_EQ(to_seconds(synchronizer_.waiting()[ready - 1].event.stamp), 3.5);
  EXPECT_GT(synchronizer_.waiting().size(), ready) << "the newest of the other stream wait";
}

TEST_F(SynchronizerTest, AtTheEndNothingWaitsLongerThanTheOdometryReaches) {
  odometry(1.0);
  for (const double t : {1.2, 1.5, 1.51}) measure(t);
  synchronizer_.end();
  EXPECT_EQ(synchronizer_.ready(), 2U);
}

}  // namespace
}  // namespace cairn
