#include "cairn/localization/odometry_buffer.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

OdometryBuffer::Intake offer(OdometryBuffer& buffer, double seconds, const Pose2& pose = {}) {
  return buffer.offer({at(seconds), pose});
}

TEST(OdometryBuffer, CutsTheArcAtTheExactStamp) {
  OdometryBuffer buffer;
  const Twist2 twist{1.0, 0.0, 0.8};
  offer(buffer, 1.0);
  offer(buffer, 2.0, exp(twist));
  const auto pose = buffer.pose_at(at(1.3));
  ASSERT_TRUE(pose);
  const Pose2 expected = exp(Twist2{0.3, 0.0, 0.24});
  EXPECT_NEAR(pose->x, expected.x, 1e-12);
  EXPECT_NEAR(pose->y, expected.y, 1e-12);
  EXPECT_NEAR(pose->theta, expected.theta, 1e-12);
  EXPECT_EQ(buffer.pose_at(at(2.0)), exp(twist));
  EXPECT_EQ(buffer.pose_at(at(1.0)), Pose2{});
}

TEST(OdometryBuffer, KnowsNothingOutsideItsSpan) {
  OdometryBuffer buffer;
  EXPECT_FALSE(buffer.pose_at(at(1.0)));
  offer(buffer, 1.0);
  EXPECT_TRUE(buffer.pose_at(at(1.0)));
  EXPECT_FALSE(buffer.pose_at(at(1.0) + Duration(1)));
  EXPECT_FALSE(buffer.pose_at(at(1.0) - Duration(1)));
}

TEST(OdometryBuffer, ForgetsOnlyWhatNoLaterStampNeeds) {
  OdometryBuffer buffer;
  for (int i = 0; i < 5; ++i) offer(buffer, i, {1.0 * i, 0.0, 0.0});
  buffer.forget_before(at(2.5));
  EXPECT_EQ(buffer.oldest(), at(2));
  EXPECT_NEAR(buffer.pose_at(at(2.5))->x, 2.5, 1e-12);
  buffer.forget_before(at(3));
  EXPECT_EQ(buffer.oldest(), at(3));
  buffer.forget_before(at(100));
  EXPECT_EQ(buffer.oldest(), at(4)) << "the newest stays: the next motion starts there";
}

TEST(OdometryBuffer, RefusesWhatIsNotNewer) {
  OdometryBuffer buffer;
  EXPECT_EQ(offer(buffer, 5.0).now, Outcome::kUsed);
  EXPECT_EQ(offer(buffer, 5.0).now, Outcome::kDroppedOutOfOrder);
  EXPECT_EQ(offer(buffer, 4.0).now, Outcome::kDroppedOutOfOrder);
  EXPECT_EQ(offer(buffer, 5.1).now, Outcome::kUsed);
}

TEST(OdometryBuffer, OneStampFromTheFutureDoesNotBlockTheRest) {
  OdometryBuffer buffer;
  offer(buffer, 1.0);
  EXPECT_EQ(offer(buffer, 3.2e7).now, Outcome::kPending);
  const auto next = offer(buffer, 1.1);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_EQ(next.held, Outcome::kDroppedOutOfOrder);
  EXPECT_FALSE(next.set_back);
  EXPECT_EQ(buffer.newest(), at(1.1));
}

TEST(OdometryBuffer, OneStampFromThePastIsDropped) {
  OdometryBuffer buffer;
  offer(buffer, 100.0);
  EXPECT_EQ(offer(buffer, 1.0).now, Outcome::kPending);
  EXPECT_EQ(offer(buffer, 100.1).held, Outcome::kDroppedOutOfOrder);
  EXPECT_EQ(buffer.oldest(), at(100));
}

TEST(OdometryBuffer, BelievesAGapThatTheNextMessageConfirms) {
  OdometryBuffer buffer;
  offer(buffer, 1.0);
  EXPECT_EQ(offer(buffer, 30.0).now, Outcome::kPending);
  EXPECT_EQ(buffer.newest(), at(1.0));
  const auto next = offer(buffer, 30.1);
  EXPECT_EQ(next.held, Outcome::kUsed);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_FALSE(next.set_back);
  EXPECT_TRUE(buffer.pose_at(at(15.0)));
}

TEST(OdometryBuffer, SlowOdometryIsUsedOneMessageLate) {
  OdometryBuffer buffer;
  offer(buffer, 0.0);
  int used = 0;
  for (int i = 1; i <= 10; ++i) used += offer(buffer, 15.0 * i).held == Outcome::kUsed ? 1 : 0;
  EXPECT_EQ(used, 9);
  EXPECT_EQ(buffer.newest(), at(135.0));
}

TEST(OdometryBuffer, StartsAnewWhereTheClockWasSetBack) {
  OdometryBuffer buffer;
  for (int i = 0; i < 5; ++i) offer(buffer, 1e6 + i);
  EXPECT_EQ(offer(buffer, 3.0).now, Outcome::kPending);
  const auto next = offer(buffer, 3.1);
  EXPECT_EQ(next.held, Outcome::kUsed);
  EXPECT_EQ(next.now, Outcome::kUsed);
  EXPECT_TRUE(next.set_back);
  EXPECT_EQ(buffer.oldest(), at(3.0));
  EXPECT_EQ(buffer.newest(), at(3.1));
}

TEST(OdometryBuffer, RecoversFromTwoMessagesOfTheFuture) {
  OdometryBuffer buffer;
  offer(buffer, 1.0);
  offer(buffer, 3.2e7);
  offer(buffer, 3.2e7 + 0.1);
  EXPECT_EQ(offer(buffer, 1.1).now, Outcome::kPending);
  EXPECT_TRUE(offer(buffer, 1.2).set_back);
  EXPECT_EQ(offer(buffer, 1.3).now, Outcome::kUsed);
}

TEST(OdometryBuffer, TheEndOfTheInputDropsWhatNobodyConfirmed) {
  OdometryBuffer buffer;
  offer(buffer, 1.0);
  EXPECT_FALSE(buffer.drop_held());
  offer(buffer, 100.0);
  EXPECT_TRUE(buffer.drop_held());
  EXPECT_FALSE(buffer.drop_held());
  EXPECT_EQ(buffer.newest(), at(1.0));
}

TEST(OdometryBuffer, StaysBoundedWhereNoScanComes) {
  OdometryBuffer buffer;
  for (std::size_t i = 0; i < OdometryBuffer::kMost + 10; ++i) offer(buffer, 0.01 * static_cast<double>(i));
  EXPECT_EQ(buffer.oldest(), at(0.1));
}

}  // namespace
}  // namespace cairn
