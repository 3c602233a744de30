#include "apps/cairn/pose_option.hpp"

#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

TEST(ParsePose, ReadsThreeNumbers) {
  EXPECT_EQ(parse_pose("--init", "0.08,-2,0.5"), (Pose2{0.08, -2, 0.5}));
  EXPECT_EQ(parse_pose("--init", " 1, 2, -0.5"), (Pose2{1, 2, -0.5}));
}

TEST(ParsePose, RefusesAnythingElse) {
  for (const char* text : {"", "1", "1,2", "1,2,3,4", "1,,3", "1,2,east", "nan,0,0", "0,0,inf"}) {
    EXPECT_THROW(parse_pose("--init", text), ConfigurationError) << text;
  }
}

}  // namespace
}  // namespace cairn::app
