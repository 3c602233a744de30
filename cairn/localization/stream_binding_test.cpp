#include "cairn/localization/stream_binding.hpp"

#include "cairn/core/errors.hpp"
#include "mini_maps.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

const Pose2 kTruth{2.0, 1.2, 0.4};

class StreamBinding : public ::testing::Test {
 protected:
  std::unique_ptr<const StreamModel> laser(const LocalizerOptions& options) const {
    const std::vector<StreamInfo> streams{{"laser", StreamKind::kLaserScan, "", std::nullopt}};
    LocalizerOptions without_odometry = options;
    without_odometry.odometry_stream = "none";
    StreamBindings bound = bind_streams(without_odometry, streams, MapLibrary(room_));
    return std::move(bound.models.front());
  }

  // People stand close to the robot over a third of the beams.
  Event::Payload crowded_scan() const {
    auto scan = std::make_shared<LaserScan>(test::scan_of(room_, kTruth, 180));
    for (std::size_t i = 0; i < 60; ++i) scan->ranges_m[i] = std::min(scan->ranges_m[i], 0.5f);
    return std::shared_ptr<const LaserScan>(scan);
  }

  // Log-likelihood of the truth, read by a belief about it.
  double score(const StreamModel& model, bool compact) {
    asked_ = 0;
    const auto z = model.bind_given(crowded_scan(), compact, [this](std::size_t at_most) {
      asked_ = at_most;
      return std::vector<Pose2>(at_most, kTruth);
    });
    double out = 0.0;
    z.log_likelihood(std::span(&kTruth, 1), std::span(&out, 1));
    return out;
  }

  const OccupancyGrid room_ = test::mini_room();
  std::size_t asked_ = 0;  // states of the belief
};

TEST_F(StreamBinding, ReadsAScanInTheSameWayWhateverIsBelieved) {
  const auto model = laser({});
  const double same = score(*model, true);
  EXPECT_EQ(asked_, 0u);
  double out = 0.0;
  model->bind(crowded_scan(), true).log_likelihood(std::span(&kTruth, 1), std::span(&out, 1));
  EXPECT_EQ(out, same);
}

TEST_F(StreamBinding, LeavesOutTheCrowdIfItIsTold) {
  LocalizerOptions skipping;
  skipping.laser.beam_skip.use = true;
  for (const std::string& name : laser_model_names()) {
    LocalizerOptions plain;
    plain.laser.model = skipping.laser.model = name;
    const double with = score(*laser(plain), true), without = score(*laser(skipping), true);
    EXPECT_GE(asked_, 50u) << name;
    EXPECT_GT(without, with) << name;
  }
}

TEST_F(StreamBinding, AllBeamsCountWhileTheBeliefIsSpread) {
  LocalizerOptions skipping;
  skipping.laser.beam_skip.use = true;
  EXPECT_EQ(score(*laser(skipping), false), score(*laser({}), false));
  EXPECT_EQ(asked_, 0u);
}

TEST_F(StreamBinding, ALostRobotIsLookedForBehindACrowdAsFarAsItIsTold) {
  LaserScan scan = test::scan_of(room_, kTruth, 180);
  for (std::size_t i = 0; i < 144; ++i) scan.ranges_m[i] = std::min(scan.ranges_m[i], 0.5f);
  const std::vector<Glimpse> surrounded{{std::make_shared<const LaserScan>(scan), {}}};
  LocalizerOptions all_beams;
  all_beams.recovery.crowd_m = 0.0;
  EXPECT_GT(laser({})->search(surrounded).value().size(),
            laser(all_beams)->search(surrounded).value().size());
}

TEST_F(StreamBinding, GradientRefinementNeedsAGradient) {
  LocalizerOptions options;
  options.recipe = "cgr";
  for (const std::string name : {"likelihood_field_prob", "v_amcl", "vector_laser", "ndt", "ondt"}) {
    options.laser.model = name;
    EXPECT_NO_THROW(laser(options)) << name;
  }
  options.laser.model = "beam";
  try {
    laser(options);
    ADD_FAILURE() << "the beam model has no gradient";
  } catch (const ConfigurationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("likelihood_field_prob"));
  }
}

}  // namespace
}  // namespace cairn
