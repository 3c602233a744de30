#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "mini_maps.hpp"
#include "recipes.hpp"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const Pose2 kTMapGrid{0.313, -0.217, 0.1};
const Pose2 kStart{2.0, 1.2, 0.4};
constexpr int kDriveSteps = 12;

struct Drive {
  std::vector<Pose2> controls, truth;
  std::vector<LaserScan> scans;
};

// A curve through the room that ends facing west.
Drive make_drive() {
  const OccupancyGrid room = mini_room(kTMapGrid);
  Drive drive;
  Pose2 pose = kStart;
  for (int i = 0; i < kDriveSteps; ++i) {
    drive.controls.push_back({0.15, 0.01, 0.2});
    pose = pose * drive.controls.back();
    drive.truth.push_back(pose);
    drive.scans.push_back(scan_of(room, pose, 90));
  }
  return drive;
}

struct Driven {
  ParticleSet<Pose2> particles;
  std::vector<Pose2> means;
};

class RecipeLaws : public ::testing::TestWithParam<RecipeCase> {
 protected:
  static const Drive& drive() {
    static const Drive kDrive = make_drive();
    return kDrive;
  }

  ParticleFilter<Pose2, Pose2> filter(int threads, std::uint64_t seed, const Pose2& T_new_map = {}) const {
    const LocalizerOptions options = GetParam().options();
    const OccupancyGrid room = mini_room(T_new_map * kTMapGrid);
    auto made = make_filter(options, seed, std::make_shared<const Executor>(threads), &room);
    made.initialize([&](const RandomStream& random, std::uint32_t i) {
      const auto n = random.normal4(i);
      return T_new_map * kStart * Pose2{0.2 * n[0], 0.2 * n[1], 0.1 * n[2]};
    });
    return made;
  }

  Driven run(int threads, std::uint64_t seed, const Pose2& T_new_map = {}) const {
    const auto field = std::make_shared<const DistanceField>(mini_room(T_new_map * kTMapGrid), 2.0);
    const LikelihoodField model(field, {}, {}, {});
    auto belief = filter(threads, seed, T_new_map);
    Driven result;
    for (std::size_t i = 0; i < drive().controls.size(); ++i) {
      belief.update(drive().controls[i], model.bind(drive().scans[i]));
      result.means.push_back(mean_of(belief.particles()));
    }
    result.particles = belief.particles();
    return result;
  }

  static Pose2 mean_of(const ParticleSet<Pose2>& particles) {
    std::vector<double> weights;
    for (const double w : particles.log_weights) weights.push_back(std::exp(w));
    return weighted_moments(particles.states, weights).mean;
  }
};

bool same_bytes(const Driven& a, const Driven& b) {
  const auto& p = a.particles;
  const auto& q = b.particles;
  return p.size() == q.size() &&
         std::memcmp(p.states.data(), q.states.data(), p.size() * sizeof(Pose2)) == 0 &&
         std::memcmp(p.log_weights.data(), q.log_weights.data(), p.size() * sizeof(double)) == 0;
}

TEST_P(RecipeLaws, TheSameBytesForAnyNumberOfThreads) {
  const Driven one = run(1, 5);
  EXPECT_TRUE(same_bytes(one, run(1, 5)));
  EXPECT_TRUE(same_bytes(one, run(2, 5)));
  EXPECT_TRUE(same_bytes(one, run(7, 5)));
  EXPECT_FALSE(same_bytes(one, run(1, 6)));
}

TEST_P(RecipeLaws, TracksTheTruth) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Driven result = run(1, seed);
    for (std::size_t i = 3; i < result.means.size(); ++i) {
      EXPECT_LT(distance(result.means[i], drive().truth[i]), 0.06) << seed << ' ' << i;
      EXPECT_LT(std::abs(angle_difference(result.means[i].theta, drive().truth[i].theta)), 0.03) << seed;
    }
  }
}

// The grid turns with the map, but the kernel's moves and the histogram's bins do not: the estimates agree
// within the noise of the particles, not to the bit.
TEST_P(RecipeLaws, FollowsTheFrameOfTheMap) {
  const Pose2 T_new_map{-40.0, 7.0, 2.2};
  const Driven here = run(1, 5), there = run(1, 5, T_new_map);
  for (std::size_t i = 3; i < here.means.size(); ++i) {
    EXPECT_LT(distance(there.means[i], T_new_map * here.means[i]), 0.03) << i;
  }
}

TEST_P(RecipeLaws, ACheckpointBringsBackEveryByte) {
  const auto field = std::make_shared<const DistanceField>(mini_room(kTMapGrid), 2.0);
  const LikelihoodField model(field, {}, {}, {});
  const auto drive_on = [&](ParticleFilter<Pose2, Pose2>& belief, std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) belief.update(drive().controls[i], model.bind(drive().scans[i]));
  };
  auto straight = filter(1, 5), returned = filter(1, 5);
  drive_on(straight, 0, 9);
  drive_on(returned, 0, 5);
  const auto checkpoint = returned.checkpoint();
  drive_on(returned, 7, 10);  // what was not to be
  returned.restore(checkpoint);
  drive_on(returned, 5, 9);
  EXPECT_TRUE(same_bytes({straight.particles(), {}}, {returned.particles(), {}}));
}

TEST_P(RecipeLaws, WeightsSumToOneAndNumbersAreFinite) {
  const Driven result = run(1, 5);
  ASSERT_EQ(result.particles.states.size(), result.particles.log_weights.size());
  EXPECT_NEAR(log_sum_exp(result.particles.log_weights), 0.0, 1e-9);
  for (const Pose2& pose : result.particles.states) ASSERT_TRUE(is_finite(pose));
}

TEST_P(RecipeLaws, AMeasurementThatSaysNothingOnlyMovesTheBelief) {
  auto belief = filter(1, 5);
  // Sensor resetting reads the likelihood's own value: one as low as this says that the robot is elsewhere.
  const bool resets = GetParam().name == "srl" || GetParam().name == "csrl";
  const double level = resets ? 0.0 : -1e6;
  const BoundUpdate<Pose2> flat{Time{}, [level](std::span<const Pose2>, std::span<double> out) {
                                  std::fill(out.begin(), out.end(), level);
                                }};
  const Pose2 before = mean_of(belief.particles());
  for (int i = 0; i < 3; ++i) belief.update({0.1, 0, 0}, flat);
  const Pose2 expected = before * Pose2{0.3, 0, 0};
  EXPECT_LT(distance(mean_of(belief.particles()), expected), 0.05);
  EXPECT_NEAR(belief.ess(), static_cast<double>(belief.particles().size()), 1e-6);
  EXPECT_EQ(belief.share_entered(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Conformance, RecipeLaws, ::testing::ValuesIn(recipes()),
                         [](const auto& chosen) { return chosen.param.name; });

TEST(Recipes, AnUnknownNameIsAConfigurationError) {
  LocalizerOptions options;
  options.recipe = "kalman";
  EXPECT_THROW(make_filter(options, 1, std::make_shared<const Executor>()), ConfigurationError);
}

}  // namespace
}  // namespace cairn::test
