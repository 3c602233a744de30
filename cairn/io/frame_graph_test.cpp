#include "cairn/io/frame_graph.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn::ros {
namespace {

StampedTransform link(const std::string& parent, const std::string& child, double x, double yaw = 0.0) {
  return {{Time(), parent},
          child,
          RigidTransform{{x, 0.0, 0.0}, {std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2)}}};
}

FrameGraph graph(const std::vector<StampedTransform>& links) {
  FrameGraph result;
  for (const StampedTransform& sample : links) result.add(sample);
  return result;
}

TEST(FrameGraph, AFrameIsWhereItIs) {
  const auto T = graph({}).constant_transform("base", "base");
  ASSERT_TRUE(T.has_value());
  EXPECT_EQ(planar(*T), (Pose2{0.0, 0.0, 0.0}));
}

TEST(FrameGraph, JoinsLinksInBothDirections) {
  const FrameGraph frames =
      graph({link("body", "base", 1.0, 1.5), link("body", "mast", 3.0), link("mast", "laser", 0.5)});
  const auto T_laser_base = frames.constant_transform("laser", "base");
  ASSERT_TRUE(T_laser_base.has_value());
  EXPECT_NEAR(planar(*T_laser_base).x, -2.5, 1e-12);
  EXPECT_NEAR(planar(*T_laser_base).theta, 1.5, 1e-12);
  const auto T_base_laser = frames.constant_transform("base", "laser");
  const Pose2 round_trip = planar(*T_laser_base * *T_base_laser);
  EXPECT_NEAR(round_trip.x, 0.0, 1e-12);
  EXPECT_NEAR(round_trip.theta, 0.0, 1e-12);
}

TEST(FrameGraph, RepeatedAndJitteringSamplesStayConstant) {
  const FrameGraph frames = graph({link("a", "b", 1.0), link("a", "b", 1.0), link("a", "b", 1.0004)});
  EXPECT_TRUE(frames.constant_transform("a", "b").has_value());
}

TEST(FrameGraph, OneMovedSampleBreaksTheLinkBothWays) {
  for (const StampedTransform& moved :
       {link("a", "b", 1.01), link("a", "b", 1.0, 0.01), link("b", "a", 1.0)}) {
    const FrameGraph frames = graph({link("a", "b", 1.0), moved});
    EXPECT_FALSE(frames.constant_transform("a", "b").has_value());
    EXPECT_FALSE(frames.constant_transform("b", "a").has_value());
  }
}

// q and -q are the same rotation.
TEST(FrameGraph, TheSignOfAQuaternionDoesNotMatter) {
  StampedTransform negative = link("a", "b", 1.0, 0.7);
  negative.T_parent_child->rotation.coeffs() *= -1.0;
  EXPECT_TRUE(graph({link("a", "b", 1.0, 0.7), negative}).constant_transform("a", "b").has_value());
}

TEST(FrameGraph, UnknownFramesAreUnknown) {
  const FrameGraph frames = graph({link("a", "b", 1.0), link("c", "c", 1.0)});
  EXPECT_FALSE(frames.constant_transform("a", "z").has_value());
  EXPECT_FALSE(frames.constant_transform("z", "a").has_value());
  EXPECT_TRUE(frames.contains("a"));
  EXPECT_FALSE(frames.contains("c"));
}

}  // namespace
}  // namespace cairn::ros
