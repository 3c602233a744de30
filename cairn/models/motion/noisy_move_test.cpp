#include "cairn/models/motion/noisy_move.hpp"

#include "cairn/core/angle.hpp"
#include "simd_paths.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const NoisyMove kMove{.turn1 = 0.3,
                      .drive = -1.2,
                      .turn2 = -0.7,
                      .aside = 0.1,
                      .sigma_turn1 = 0.4,
                      .sigma_drive = 0.2,
                      .sigma_turn2 = 2.0,
                      .sigma_aside = 0.05};

std::vector<Pose2> some_states(std::size_t n) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  std::vector<Pose2> states;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto u = random.uniform4(i);
    states.push_back({200.0 * u[0] - 100.0, 200.0 * u[1], kTwoPi * u[2] - kPi});
  }
  return states;
}

std::vector<Pose2> moved(std::vector<Pose2> states, std::size_t per_batch) {
  const RandomStream random(2, RandomPurpose::kTest, 0);
  NormalBatch noise;
  for (std::size_t begin = 0; begin < states.size(); begin += per_batch) {
    const std::size_t count = std::min(per_batch, states.size() - begin);
    noise.fill(random, static_cast<std::uint32_t>(begin), count);
    apply(kMove, std::span(states).subspan(begin, count), noise);
  }
  return states;
}

TEST(NoisyMove, TheBatchIsOneByOne) {
  const std::vector<Pose2> states = some_states(1000);
  const RandomStream random(2, RandomPurpose::kTest, 0);
  NormalBatch noise;
  const std::vector<Pose2> found = moved(states, 128);
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    noise.fill(random, i, 1);
    const Pose2 expected = kMove.applied(states[i], noise.number[0][0], noise.number[1][0],
                                         noise.number[2][0], noise.number[3][0]);
    EXPECT_NEAR(found[i].x, expected.x, 1e-13);
    EXPECT_NEAR(found[i].y, expected.y, 1e-13);
    EXPECT_NEAR(angle_difference(found[i].theta, expected.theta), 0.0, 1e-14);
    EXPECT_TRUE(found[i].theta >= -kPi && found[i].theta < kPi);
  }
}

TEST(NoisyMove, EveryPathAndEveryBatchGivesTheSameBits) {
  const std::vector<Pose2> states = some_states(517);
  const std::vector<Pose2> expected = moved(states, 128);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t per_batch : {1, 5, 64, 128}) {
      const std::vector<Pose2> found = moved(states, per_batch);
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), sizeof(Pose2) * found.size()), 0)
          << name_of(path) << ", batches of " << per_batch;
    }
  });
}

// Headings just inside and outside their interval, without noise.
TEST(NoisyMove, HeadingsStayInTheirInterval) {
  const double below_pi = std::nextafter(kPi, 0.0), above_pi = std::nextafter(kPi, 4.0);
  NormalBatch noise;
  noise.fill({1, RandomPurpose::kTest, 0}, 0, 8);
  for (const double theta :
       {-kPi, kPi, below_pi, -below_pi, above_pi, -above_pi, 3.0 * kPi, 0.0, -0.0, 1e5, 1e9}) {
    Pose2 state{1, 2, theta};
    apply({}, std::span(&state, 1), noise);
    EXPECT_TRUE(state.theta >= -kPi && state.theta < kPi) << theta;
    EXPECT_NEAR(angle_difference(state.theta, normalize_angle(theta)), 0.0, 1e-11) << theta;
    EXPECT_EQ(state.x, 1.0);
  }
}

TEST(NoisyMove, WhatIsNotANumberStaysThat) {
  NormalBatch noise;
  noise.fill({1, RandomPurpose::kTest, 0}, 0, 8);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    std::vector<Pose2> states = {{1, 2, bad}, {1, 2, 3}};
    apply(kMove, states, noise);
    EXPECT_FALSE(is_finite(states[0]));
    EXPECT_TRUE(is_finite(states[1]));
  }
}

NoisyMove straight_on() {
  NoisyMove move = kMove;
  move.aside = move.sigma_aside = 0.0;
  return move;
}

std::vector<Pose2> moved_by_three(std::vector<Pose2> states, std::size_t per_batch) {
  const RandomStream random(2, RandomPurpose::kTest, 0);
  Normal3Batch noise;
  for (std::size_t begin = 0; begin < states.size(); begin += per_batch) {
    const std::size_t count = std::min(per_batch, states.size() - begin);
    noise.fill(random, static_cast<std::uint32_t>(begin), count);
    apply(straight_on(), std::span(states).subspan(begin, count), noise);
  }
  return states;
}

TEST(NoisyMoveByThreeNumbers, IsOneByOne) {
  std::vector<Pose2> states = some_states(1000);
  states[17].theta = 9.0, states[18].theta = -kPi, states[500].theta = -31.0;
  const std::vector<Pose2> found = moved_by_three(states, 128);
  const RandomStream random(2, RandomPurpose::kTest, 0);
  Normal3Batch noise;
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    noise.fill(random, i, 1);
    const auto number = [&](std::size_t k) { return noise.number(k)[0] * Normal3::kUnit; };
    const Pose2 expected = straight_on().applied(states[i], number(0), number(1), number(2), 0.0);
    EXPECT_NEAR(found[i].x, expected.x, 1e-13);
    EXPECT_NEAR(found[i].y, expected.y, 1e-13);
    EXPECT_NEAR(angle_difference(found[i].theta, expected.theta), 0.0, 1e-13) << i;
    EXPECT_TRUE(found[i].theta >= -kPi && found[i].theta < kPi);
  }
}

TEST(NoisyMoveByThreeNumbers, EveryPathAndEveryBatchGivesTheSameBits) {
  const std::vector<Pose2> states = some_states(517);
  const std::vector<Pose2> expected = moved_by_three(states, 128);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t per_batch : {1, 5, 64, 128}) {
      const std::vector<Pose2> found = moved_by_three(states, per_batch);
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), sizeof(Pose2) * found.size()), 0)
          << name_of(path) << ", batches of " << per_batch;
    }
  });
}

}  // namespace
}  // namespace cairn
