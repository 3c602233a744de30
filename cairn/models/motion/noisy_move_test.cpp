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

// The law of noisy_move.hpp: how far a state may be from its plain form, `length` the way driven, its mean
// and its noise both counted as positive.
void expect_close(const Pose2& found, const Pose2& expected, const NoisyMove& move, double length) {
  constexpr double kHeading = 4e-9, kShareOfNoise = 4e-6, kShareOfStep = 5e-7;
  const double turned = kHeading + kShareOfNoise * move.sigma_turn1;
  const double rounding = 1e-15 * (std::abs(expected.x) + std::abs(expected.y));
  EXPECT_NEAR(std::hypot(found.x - expected.x, found.y - expected.y), 0.0,
              rounding + length * (kShareOfStep + turned));
  EXPECT_NEAR(angle_difference(found.theta, expected.theta), 0.0, turned + kShareOfNoise * move.sigma_turn2);
  EXPECT_TRUE(found.theta >= -kPi && found.theta < kPi);
}

TEST(NoisyMove, TheBatchIsOneByOne) {
  const std::vector<Pose2> states = some_states(1000);
  const RandomStream random(2, RandomPurpose::kTest, 0);
  NormalBatch noise;
  const std::vector<Pose2> found = moved(states, 128);
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    noise.fill(random, i, 1);
    const auto number = [&](std::size_t k) { return static_cast<double>(noise.number[k][0]); };
    const Pose2 expected = kMove.applied(states[i], number(0), number(1), number(2), number(3));
    const double along = std::abs(kMove.drive) + kMove.sigma_drive * std::abs(number(1));
    const double across = std::abs(kMove.aside) + kMove.sigma_aside * std::abs(number(3));
    expect_close(found[i], expected, kMove, std::hypot(along, across));
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
    EXPECT_NEAR(angle_difference(state.theta, normalize_angle(theta)), 0.0, 2e-9) << theta;
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

std::vector<Pose2> moved_by_three(const NoisyMove& move, std::vector<Pose2> states, std::size_t per_batch) {
  const RandomStream random(2, RandomPurpose::kTest, 0);
  Normal3Batch noise;
  for (std::size_t begin = 0; begin < states.size(); begin += per_batch) {
    const std::size_t count = std::min(per_batch, states.size() - begin);
    noise.fill(random, static_cast<std::uint32_t>(begin), count);
    apply(move, std::span(states).subspan(begin, count), noise);
  }
  return states;
}

// Moves all states plainly and on all lanes, and returns the mean differences.
Pose2 expect_one_by_one(const NoisyMove& move, const std::vector<Pose2>& states) {
  const std::vector<Pose2> found = moved_by_three(move, states, 512);
  const RandomStream random(2, RandomPurpose::kTest, 0);
  const auto n = static_cast<double>(states.size());
  Pose2 mean;
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    const auto number = random.normal3(i);
    const Pose2 expected = move.applied(states[i], number[0], number[1], number[2], 0.0);
    expect_close(found[i], expected, move, std::abs(move.drive) + move.sigma_drive * std::abs(number[1]));
    mean.x += (found[i].x - expected.x) / n;
    mean.y += (found[i].y - expected.y) / n;
    mean.theta += angle_difference(found[i].theta, expected.theta) / n;
  }
  return mean;
}

TEST(NoisyMoveByThreeNumbers, IsOneByOne) {
  std::vector<Pose2> states = some_states(1000);
  states[17].theta = 9.0, states[18].theta = -kPi, states[500].theta = -31.0;
  expect_one_by_one(straight_on(), states);
}

// From steps of 0.1 mm to 10 km, and from hardly any noise to turns of many circles.
TEST(NoisyMoveByThreeNumbers, ErrorsAreSharesOfTheStepAndOfItsNoise) {
  const std::vector<Pose2> states = some_states(512);
  for (const double drive : {-1e4, -0.3, 0.0, 1e-4, 0.1, 20.0}) {
    for (const double sigma : {0.0, 1e-7, 6e-4, 0.01, 0.3, 3.0, 40.0}) {
      const NoisyMove move{.turn1 = 3.1,
                           .drive = drive,
                           .turn2 = -40.0 * sigma,
                           .sigma_turn1 = sigma,
                           .sigma_drive = std::abs(drive) * sigma,
                           .sigma_turn2 = 0.1 * sigma};
      expect_one_by_one(move, states);
    }
  }
}

// Rounding has no direction: over many steps errors do not add up. Bounds: 1/40 of those of a single state.
TEST(NoisyMoveByThreeNumbers, ErrorsHaveNoDirection) {
  const NoisyMove step{.turn1 = 0.02,
                       .drive = 0.1,
                       .turn2 = 0.01,
                       .sigma_turn1 = 0.05,
                       .sigma_drive = 0.03,
                       .sigma_turn2 = 0.05};
  const Pose2 mean = expect_one_by_one(step, some_states(20'000));
  EXPECT_NEAR(mean.x, 0.0, 2e-9);
  EXPECT_NEAR(mean.y, 0.0, 2e-9);
  EXPECT_NEAR(mean.theta, 0.0, 5e-9);
}

TEST(NoisyMoveByThreeNumbers, EveryPathAndEveryBatchGivesTheSameBits) {
  std::vector<Pose2> states = some_states(1217);
  states[700].theta = 1e9;
  const std::vector<Pose2> expected = moved_by_three(straight_on(), states, 512);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t per_batch : {1, 5, 64, 128, 512}) {
      const std::vector<Pose2> found = moved_by_three(straight_on(), states, per_batch);
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), sizeof(Pose2) * found.size()), 0)
          << name_of(path) << ", batches of " << per_batch;
    }
  });
}

}  // namespace
}  // namespace cairn
