#include "cairn/models/registry.hpp"

#include "cairn/core/errors.hpp"
#include "mini_maps.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const MapSet& room() {
  static const MapSet maps(std::make_shared<const OccupancyGrid>(test::mini_room()));
  return maps;
}

double score(const LaserModel& model, const LaserScan& scan, const Pose2& pose) {
  double out = 0.0;
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

TEST(LaserModelRegistry, MakesEveryModelThatItNames) {
  const LaserModelOptions options;
  EXPECT_EQ(laser_model_names().front(), options.model);
  for (const std::string& name : laser_model_names()) {
    EXPECT_NE(make_laser_model(name, {room(), {}, {}, options}), nullptr) << name;
  }
}

TEST(LaserModelRegistry, RefusesAnUnknownName) {
  const LaserModelOptions options;
  EXPECT_THROW(make_laser_model("sonar", {room(), {}, {}, options}), ConfigurationError);
}

TEST(LaserModelRegistry, AWidenedModelForgivesMoreThanTheFineOne) {
  const LaserModelOptions fine, wide = widened(fine, 0.4, 6.0);
  const Pose2 truth{2.0, 1.2, 0.4}, beside = truth * Pose2{0.3, 0.2, 0.05};
  const LaserScan scan = test::scan_of(*room().grid(), truth, 180);
  for (const std::string& name : laser_model_names()) {
    const auto loss = [&](const LaserModelOptions& options) {
      const auto model = make_laser_model(name, {room(), {}, {}, options});
      return score(*model, scan, truth) - score(*model, scan, beside);
    };
    EXPECT_GT(loss(wide), 0.0) << name;
    EXPECT_LT(loss(wide), loss(fine)) << name;
  }
}

TEST(LaserModelRegistry, AScanCountsAsManyBeamsAsItIsToldTo) {
  const Pose2 truth{2.0, 1.2, 0.4}, beside = truth * Pose2{0.05, 0.02, 0.02};
  const LaserScan scan = test::scan_of(*room().grid(), truth, 180);
  for (const std::string& name : laser_model_names()) {
    if (name == "likelihood_field") continue;  // AMCL's weight is no product of beams
    const auto loss = [&](double effective_beams) {
      const LaserModelOptions options = with_effective_beams({}, effective_beams);
      const auto model = make_laser_model(name, {room(), {}, {}, options});
      return score(*model, scan, truth) - score(*model, scan, beside);
    };
    EXPECT_NEAR(loss(5.0) / loss(20.0), 0.25, 0.02) << name;
  }
}

}  // namespace
}  // namespace cairn
