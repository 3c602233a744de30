#include "cairn/models/motion/differential_drive.hpp"

#include "cairn/core/angle.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two-sided bound of a standard normal number with false-alarm probability 1e-6.
constexpr double kAlarm = 4.892;
constexpr std::size_t kSamples = 100'000;

DifferentialDriveOptions alphas(double a1, double a2, double a3, double a4) {
  DifferentialDriveOptions o;
  o.alpha1 = a1, o.alpha2 = a2, o.alpha3 = a3, o.alpha4 = a4;
  return o;
}

std::vector<Pose2> moved(const DifferentialDriveOptions& options, const Pose2& control,
                         const Pose2& start = {}, std::size_t n = kSamples) {
  std::vector<Pose2> states(n, start);
  DifferentialDrive(options).propagate(control, states, {1, RandomPurpose::kTest, 1});
  return states;
}

// What the single precision of noisy_move.hpp leaves after a step of a length without noise.
void expect_pose(const Pose2& a, const Pose2& b, double length) {
  EXPECT_NEAR(a.x, b.x, 5e-7 * length + 1e-15);
  EXPECT_NEAR(a.y, b.y, 5e-7 * length + 1e-15);
  EXPECT_NEAR(angle_difference(a.theta, b.theta), 0.0, 4e-9);
}

TEST(DifferentialDrive, WithoutNoiseItComposes) {
  const Pose2 controls[] = {{0, 0, 0},         {1, 0, 0},        {-1, 0, 0},          {0.3, 0.1, 0.2},
                            {-0.3, 0.1, -0.2}, {0, 0, 1.5},      {0, 0, -kPi},        {0.005, 0, 0},
                            {-0.005, 0, 0},    {0, 0.009, 0.1},  {-0.006, -0.006, 2}, {0, 1, 0},
                            {0, -1, 3.1},      {1e-9, -1e-9, 0}, {1e3, 2e3, 3}};
  for (const Pose2& control : controls) {
    for (const Pose2& start : {Pose2{}, Pose2{3, -2, 3.1}, Pose2{-1, 5, -1.6}}) {
      const Pose2 end = moved(alphas(0, 0, 0, 0), control, start, 1)[0];
      expect_pose(end, start * control, std::hypot(control.x, control.y));
      EXPECT_TRUE(end.theta >= -kPi && end.theta < kPi);
    }
  }
}

// Two turns of pi would, with alpha1 alone, scatter the robot over a circle.
TEST(DifferentialDrive, DrivingBackwardsIsNoTurn) {
  for (const Pose2& end : moved(alphas(1, 0, 0, 0), {-1, 0, 0}, {}, 1000)) expect_pose(end, {-1, 0, 0}, 1.0);
  for (const Pose2& end : moved(alphas(1, 0, 0, 0), {-0.005, 0, 0}, {}, 1000))
    expect_pose(end, {-0.005, 0, 0}, 0.005);
}

TEST(DifferentialDrive, TurningInPlaceStaysThere) {
  const auto ends = moved(alphas(0.04, 0, 0.04, 0), {0, 0, 0.5});
  double squares = 0.0;
  for (const Pose2& end : ends) {
    EXPECT_EQ(end.x, 0.0);
    EXPECT_EQ(end.y, 0.0);
    squares += (end.theta - 0.5) * (end.theta - 0.5);
  }
  const double expected = 0.04 * 0.25;
  EXPECT_NEAR(squares / kSamples, expected, kAlarm * expected * std::sqrt(2.0 / kSamples));
}

// Turn, drive, turn of each sample, recovered from its end: the moments are those of the formulas.
struct Moments {
  std::array<double, 3> mean{}, variance{};
  std::array<double, 3> correlation{};  // turn1-drive, drive-turn2, turn2-turn1
};

Moments moments_of(const std::vector<std::array<double, 3>>& samples) {
  Moments m;
  const auto n = static_cast<double>(samples.size());
  for (const auto& s : samples)
    for (std::size_t k = 0; k < 3; ++k) m.mean[k] += s[k] / n;
  std::array<double, 3> products{};
  for (const auto& s : samples) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      m.variance[k] += (s[k] - m.mean[k]) * (s[k] - m.mean[k]) / n;
      products[k] += (s[k] - m.mean[k]) * (s[next] - m.mean[next]) / n;
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    m.correlation[k] = products[k] / std::sqrt(m.variance[k] * m.variance[(k + 1) % 3]);
  return m;
}

void expect_moments(double direction, double turn1, double turn2) {
  constexpr double kDrive = 1.2, kA1 = 0.01, kA2 = 0.002, kA3 = 0.003, kA4 = 0.004;
  const Pose2 control{direction * kDrive * std::cos(turn1), direction * kDrive * std::sin(turn1),
                      turn1 + turn2};
  std::vector<std::array<double, 3>> samples;
  for (const Pose2& end : moved(alphas(kA1, kA2, kA3, kA4), control)) {
    const double first = std::atan2(direction * end.y, direction * end.x);
    samples.push_back({first, std::hypot(end.x, end.y), angle_difference(end.theta, first)});
  }
  const Moments m = moments_of(samples);
  const double d2 = kDrive * kDrive, t1 = turn1 * turn1, t2 = turn2 * turn2;
  const std::array mean = {turn1, kDrive, turn2};
  const std::array variance = {kA1 * t1 + kA2 * d2, kA3 * d2 + kA4 * (t1 + t2), kA1 * t2 + kA2 * d2};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(m.mean[k], mean[k], kAlarm * std::sqrt(variance[k] / kSamples)) << k;
    EXPECT_NEAR(m.variance[k], variance[k], kAlarm * variance[k] * std::sqrt(2.0 / kSamples)) << k;
    EXPECT_NEAR(m.correlation[k], 0.0, kAlarm / std::sqrt(kSamples)) << k;
  }
}

TEST(DifferentialDrive, MomentsOfTheFormulas) {
  expect_moments(1.0, 0.4, -0.7);
  expect_moments(-1.0, 0.4, -0.7);  // the same backwards
  expect_moments(1.0, -1.2, 0.1);
}

TEST(DifferentialDrive, TheLeastNoiseIsAddedToEveryMove) {
  DifferentialDriveOptions o = alphas(0, 0, 0, 0);
  o.sigma_min_m = 0.02;
  o.sigma_min_rad = 0.03;
  for (const Pose2& control : {Pose2{0, 0, 0}, Pose2{0.5, 0, 0}}) {
    std::vector<std::array<double, 3>> samples;
    for (const Pose2& end : moved(o, control)) samples.push_back({end.x - control.x, end.y, end.theta});
    const Moments m = moments_of(samples);
    const std::array sigma = {0.02, 0.02, 0.03};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(m.mean[k], 0.0, kAlarm * sigma[k] / std::sqrt(kSamples));
      EXPECT_NEAR(std::sqrt(m.variance[k]), sigma[k], kAlarm * sigma[k] / std::sqrt(2.0 * kSamples));
      EXPECT_NEAR(m.correlation[k], 0.0, kAlarm / std::sqrt(kSamples));
    }
  }
}

TEST(DifferentialDrive, StandingStillAddsNothing) {
  const Pose2 start{1, 2, 3};
  for (const Pose2& end : moved({}, {0, 0, 0}, start, 100)) EXPECT_EQ(end, start);
}

TEST(DifferentialDrive, ChunksGiveTheSameBytes) {
  const DifferentialDrive model{DifferentialDriveOptions{}};
  const RandomStream random(1, RandomPurpose::kMotion, 4);
  std::vector<Pose2> whole(1000, Pose2{1, 2, 3}), pieces = whole;
  model.propagate({0.2, 0.1, 0.3}, whole, random);
  for (std::size_t begin = 0; begin < 1000; begin += 37) {
    const std::size_t count = std::min<std::size_t>(37, 1000 - begin);
    model.propagate({0.2, 0.1, 0.3}, std::span(pieces).subspan(begin, count),
                    random.from_item(static_cast<std::uint32_t>(begin)));
  }
  EXPECT_EQ(std::memcmp(whole.data(), pieces.data(), whole.size() * sizeof(Pose2)), 0);
  EXPECT_NE(whole[0], whole[1]);
}

}  // namespace
}  // namespace cairn
