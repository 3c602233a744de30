#include "cairn/sim/people.hpp"

#include "small_world.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Trajectory still(double seconds) {
  return {{Time{}, {4.0, 3.0, 0.0}}, {time_from_seconds(seconds), {4.0, 3.0, 0.0}}};
}

World world_with(const WorldPeopleOptions& people) {
  WorldOptions options = test::small_world_options();
  options.people = people;
  return make_world(options);
}

double apart(const Point2& a, const Point2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double touching_m(const World& world) { return world.options.people.radius_m + world.options.robot.radius_m; }

TEST(People, WhoWalksWalksAndKeepsOffWallsAndRobot) {
  WorldPeopleOptions options;
  options.walking = 4;
  const World world = world_with(options);
  const People people(world, still(60.0), 1);
  double walked = 0.0;
  for (double t = 0.0; t < 60.0; t += 0.1) {
    const auto now = people.at(t), next = people.at(t + 0.1);
    ASSERT_EQ(now.size(), 4U);
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_TRUE(world.planner.is_free(now[i].center));
      walked += apart(now[i].center, next[i].center);
      EXPECT_LE(apart(now[i].center, next[i].center), 0.1 * 1.3 * 1.5 * options.speed_mps + 1e-9);
      EXPECT_GE(apart(now[i].center, {4.0, 3.0}), touching_m(world) - 0.01) << "nobody is inside the robot";
    }
  }
  EXPECT_GT(walked / 4.0, 15.0) << "60 s at about 1 m/s";
}

// The robot goes to and fro faster than most can give way to it.
TEST(People, NobodyIsInsideARobotThatDrivesThroughThem) {
  WorldPeopleOptions options;
  options.walking = 8;
  const World world = world_with(options);
  Trajectory robot;
  for (int i = 0; i <= 3000; ++i) {
    const double t = 0.02 * i;
    robot.push_back({time_from_seconds(t), {4.0 + 2.5 * std::sin(0.5 * t), 3.0, 0.0}});
  }
  const People people(world, robot, 1);
  int touched = 0;
  for (int i = 0; i < 3000; ++i) {
    for (const Cylinder& person : people.at(0.02 * i)) {
      const double distance = apart(person.center, {robot[i].pose.x, robot[i].pose.y});
      EXPECT_GE(distance, touching_m(world) - 0.03) << "at " << 0.02 * i << " s";
      if (distance < touching_m(world) + 0.03) ++touched;
    }
  }
  EXPECT_GT(touched, 50) << "else nothing was tried";
}

TEST(People, WhoStandsStandsBesideTheRobotsWay) {
  WorldPeopleOptions options;
  options.standing = 5;
  const World world = world_with(options);
  const People people(world, still(10.0), 2);
  const auto all = people.at(3.0);
  ASSERT_EQ(all.size(), 5U);
  for (const Cylinder& person : all) {
    EXPECT_GT(apart(person.center, {4.0, 3.0}), 0.3 + 0.22);
    EXPECT_TRUE(world.planner.is_free(person.center));
  }
}

TEST(People, ACrowdComesAndGoesWithTheRobot) {
  WorldPeopleOptions options;
  options.crowd = 6;
  options.crowd_from_s = 2.0;
  options.crowd_to_s = 5.0;
  const People people(world_with(options), still(10.0), 1);
  EXPECT_TRUE(people.at(1.0).empty());
  EXPECT_TRUE(people.at(6.0).empty());
  const auto crowd = people.at(3.0);
  ASSERT_EQ(crowd.size(), 6U);
  for (const Cylinder& person : crowd) EXPECT_NEAR(apart(person.center, {4.0, 3.0}), 0.9, 1e-9);
}

}  // namespace
}  // namespace cairn
