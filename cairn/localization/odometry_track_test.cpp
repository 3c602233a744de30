#include "cairn/localization/odometry_track.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

OdometryTrack::Intake offer(OdometryTrack& track, double seconds, const Pose2& pose = {}) {
  return track.offer({at(seconds), pose});
}

TEST(OdometryTrack, CutsTheArcAtTheExactStamp) {
  OdometryTrack track;
  const Twist2 twist{1.0, 0.0, 0.8};
  offer(track, 1.0);
  offer(track, 2.0, exp(twist));
  const auto pose = track.pose_at(at(1.3));
  ASSERT_TRUE(pose);
  const Pose2 expected = exp(Twist2{0.3, 0.0, 0.24});
  EXPECT_NEAR(pose->x, expected.x, 1e-12);
  EXPECT_NEAR(pose->y, expected.y, 1e-12);
  EXPECT_NEAR(pose->theta, expected.theta, 1e-12);
  EXPECT_EQ(track.pose_at(at(2.0)), exp(twist));
  EXPECT_EQ(track.pose_at(at(1.0)), Pose2{});
}

TEST(OdometryTrack, KnowsNothingOutsideItsSpan) {
  OdometryTrack track;
  EXPECT_FALSE(track.pose_at(at(1.0)));
  offer(track, 1.0);
  EXPECT_TRUE(track.pose_at(at(1.0)));
  EXPECT_FALSE(track.pose_at(at(1.0) + Duration(1)));
  EXPECT_FALSE(track.pose_at(at(1.0) - Duration(1)));
}

TEST(OdometryTrack, ForgetsOnlyWhatNoLaterStampNeeds) {
  OdometryTrack track;
  for (int i = 0; i < 5; ++i) offer(track, i, {1.0 * i, 0.0, 0.0});
  track.forget_before(at(2.5));
  EXPECT_EQ(track.oldest(), at(2));
  EXPECT_NEAR(track.pose_at(at(2.5))->x, 2.5, 1e-12);
  track.forget_before(at(3));
  EXPECT_EQ(track.oldest(), at(3));
  track.forget_before(at(100));
  EXPECT_EQ(track.oldest(), at(4)) << "the newest stays: the next motion starts there";
}

TEST(OdometryTrack, PutsALateMessageAtItsPlace) {
  OdometryTrack track;
  offer(track, 4.0, {4, 0, 0});
  offer(track, 6.0, {6, 0, 0});
  EXPECT_NEAR(track.pose_at(at(5.0))->x, 5.0, 1e-12);
  const auto late = offer(track, 5.0, {5.5, 0, 0});
  EXPECT_EQ(late.now, Outcome::kReplayed);
  EXPECT_EQ(late.changed_after, at(4.0)) << "motions from there on are others now";
  EXPECT_EQ(track.pose_at(at(5.0)), (Pose2{5.5, 0, 0}));
  EXPECT_EQ(offer(track, 5.0).now, Outcome::kDroppedDuplicate);
  EXPECT_EQ(offer(track, 3.0).changed_after, Time::min()) << "all that began before the first pose";
}

TEST(OdometryTrack, RefusesWhatIsOlderThanItKeeps) {
  OdometryTrack track;
  for (int i = 0; i < 5; ++i) offer(track, i);
  track.forget_before(at(2.5));
  EXPECT_EQ(offer(track, 1.9).now, Outcome::kDroppedStale);
  EXPECT_EQ(offer(track, 2.2).now, Outcome::kReplayed);
}

TEST(OdometryTrack, AnyOrderOfArrivalGivesTheSameTrack) {
  const std::vector<double> orders[] = {{1, 2, 3, 4}, {4, 3, 2, 1}, {2, 4, 1, 3}};
  for (const auto& order : orders) {
    OdometryTrack track;
    for (const double t : order) offer(track, t, {t * t, 0, 0});
    for (const double t : {1.0, 1.5, 2.7, 3.3, 4.0}) {
      const double before = std::floor(t), f = t - before;
      const double expected = (1 - f) * before * before + f * (before + 1) * (before + 1);
      EXPECT_NEAR(track.pose_at(at(t))->x, expected, 1e-12) << t;
    }
  }
}

TEST(OdometryTrack, CutsControlsAnywhereWithoutLoss) {
  OdometryTrack track;
  const Twist2 twist{1.0, 0.0, 0.8};
  for (int i = 0; i <= 3; ++i) offer(track, i, exp({i * twist.x, 0.0, i * twist.theta}));
  Pose2 sum;
  OdometryAnchor anchor = track.anchor_at(at(0.2));
  for (const double t : {0.9, 1.0, 2.34, 2.7}) {
    const PoseControl control = track.control(anchor, at(t));
    EXPECT_EQ(control.unknown_s, 0.0);
    sum = sum * control.T_before_after;
    anchor = track.anchor_at(at(t));
  }
  const Pose2 expected = exp({2.5 * twist.x, 0.0, 2.5 * twist.theta});
  EXPECT_NEAR(sum.x, expected.x, 1e-12);
  EXPECT_NEAR(sum.y, expected.y, 1e-12);
  EXPECT_NEAR(sum.theta, expected.theta, 1e-12);
}

TEST(OdometryTrack, SaysForHowLongItKnowsNothing) {
  OdometryTrack track;
  const OdometryAnchor origin = track.anchor_at(at(0.0));
  EXPECT_FALSE(origin.known);
  EXPECT_NEAR(track.control(origin, at(1.5)).unknown_s, 1.5, 1e-12) << "no odometry at all";
  offer(track, 1.0, {1, 0, 0});
  offer(track, 2.0, {2, 0, 0});
  EXPECT_NEAR(track.control(origin, at(1.5)).unknown_s, 1.0, 1e-12) << "before it began";
  EXPECT_NEAR(track.control(origin, at(1.5)).T_before_after.x, 0.5, 1e-12);
  const OdometryAnchor after = track.anchor_at(at(2.5));
  EXPECT_NEAR(track.control(track.anchor_at(at(1.5)), at(2.5)).unknown_s, 0.5, 1e-12) << "after it ended";
  EXPECT_NEAR(track.control(after, at(2.7)).unknown_s, 0.2, 1e-12);
  offer(track, 4.0, {4, 0, 0});
  EXPECT_EQ(track.control(after, at(3.5)).unknown_s, 0.0) << "it goes on, and tells where the robot was";
  EXPECT_NEAR(track.control(after, at(3.5)).T_before_after.x, 1.0, 1e-12);
}

TEST(OdometryTrack, AnAnchorThatWasKnownStaysWhenItsTimeIsForgotten) {
  OdometryTrack track;
  for (int i = 0; i < 100; ++i) offer(track, i, {1.0 * i, 0, 0});
  const OdometryAnchor long_ago = track.anchor_at(at(3.0));
  track.forget_before(at(90.0));
  EXPECT_EQ(track.control(long_ago, at(95.0)).unknown_s, 0.0);
  EXPECT_NEAR(track.control(long_ago, at(95.0)).T_before_after.x, 92.0, 1e-12);
}

TEST(OdometryTrack, KnowsTheMessageBefore) {
  OdometryTrack track;
  for (const double t : {1.0, 2.0, 3.0}) offer(track, t);
  EXPECT_EQ(track.at_or_before(at(2.0)), at(2.0));
  EXPECT_EQ(track.at_or_before(at(2.9)), at(2.0));
  EXPECT_EQ(track.at_or_before(at(9.0)), at(3.0));
  EXPECT_EQ(track.at_or_before(at(0.0)), at(1.0));
}

TEST(OdometryTrack, OneStampFromTheFutureDoesNotBlockTheRest) {
  OdometryTrack track;
  offer(track, 1.0);
  EXPECT_EQ(offer(track, 3.2e7).now, Outcome::kPending);
  const auto next = offer(track, 1.1);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_EQ(next.held, Outcome::kDroppedOutOfOrder);
  EXPECT_FALSE(next.set_back);
  EXPECT_EQ(track.newest().stamp, at(1.1));
}

TEST(OdometryTrack, OneStampFromThePastIsDropped) {
  OdometryTrack track;
  offer(track, 100.0);
  EXPECT_EQ(offer(track, 1.0).now, Outcome::kPending);
  EXPECT_EQ(offer(track, 100.1).held, Outcome::kDroppedOutOfOrder);
  EXPECT_EQ(track.oldest(), at(100));
}

TEST(OdometryTrack, BelievesAGapThatTheNextMessageConfirms) {
  OdometryTrack track;
  offer(track, 1.0);
  EXPECT_EQ(offer(track, 30.0).now, Outcome::kPending);
  EXPECT_EQ(track.newest().stamp, at(1.0));
  const auto next = offer(track, 30.1);
  EXPECT_EQ(next.held, Outcome::kUsed);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_FALSE(next.set_back);
  EXPECT_TRUE(track.pose_at(at(15.0)));
}

TEST(OdometryTrack, SlowOdometryIsUsedOneMessageLate) {
  OdometryTrack track;
  offer(track, 0.0);
  int used = 0;
  for (int i = 1; i <= 10; ++i) used += offer(track, 15.0 * i).held == Outcome::kUsed ? 1 : 0;
  EXPECT_EQ(used, 9);
  EXPECT_EQ(track.newest().stamp, at(135.0));
}

TEST(OdometryTrack, StartsAnewWhereTheClockWasSetBack) {
  OdometryTrack track;
  for (int i = 0; i < 5; ++i) offer(track, 1e6 + i);
  EXPECT_EQ(offer(track, 3.0).now, Outcome::kPending);
  const auto next = offer(track, 3.1);
  EXPECT_EQ(next.held, Outcome::kUsed);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_TRUE(next.set_back);
  EXPECT_EQ(track.oldest(), at(3.0));
  EXPECT_EQ(track.newest().stamp, at(3.1));
}

TEST(OdometryTrack, RecoversFromTwoMessagesOfTheFuture) {
  OdometryTrack track;
  offer(track, 1.0);
  offer(track, 3.2e7);
  offer(track, 3.2e7 + 0.1);
  EXPECT_EQ(offer(track, 1.1).now, Outcome::kPending);
  EXPECT_TRUE(offer(track, 1.2).set_back);
  EXPECT_EQ(offer(track, 1.3).now, Outcome::kUsed);
}

TEST(OdometryTrack, TheEndOfTheInputDropsWhatNobodyConfirmed) {
  OdometryTrack track;
  offer(track, 1.0);
  EXPECT_FALSE(track.drop_held());
  offer(track, 100.0);
  EXPECT_TRUE(track.drop_held());
  EXPECT_FALSE(track.drop_held());
  EXPECT_EQ(track.newest().stamp, at(1.0));
}

TEST(OdometryTrack, StaysBoundedWhereNoScanComes) {
  OdometryTrack track;
  for (std::size_t i = 0; i < OdometryTrack::kMost + 10; ++i) offer(track, 0.01 * static_cast<double>(i));
  EXPECT_EQ(track.oldest(), at(0.1));
}

}  // namespace
}  // namespace cairn
