#include "cairn/eval/alignment.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<PosePair> figure_eight(const Pose2& T_reference_estimate) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < 50; ++i) {
    const Pose2 estimate{10 * std::sin(0.2 * i), 5 * std::sin(0.4 * i), normalize_angle(0.3 * i)};
    pairs.push_back({time_from_seconds(i), T_reference_estimate * estimate, estimate});
  }
  return pairs;
}

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_difference(a.theta, b.theta), 0.0, tolerance);
}

TEST(RigidAlignment, FindsTheTransformThatWasApplied) {
  for (const Pose2& T : {Pose2{}, Pose2{3, -4, 0.7}, Pose2{1e6, 2e6, -kPi}, Pose2{0, 0, 1e-9}}) {
    expect_same(rigid_alignment(figure_eight(T)), T, 1e-6);
  }
}

TEST(RigidAlignment, NoNearbyTransformIsBetter) {
  auto pairs = figure_eight({3, -4, 0.7});
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].reference.x += 0.3 * std::cos(1.7 * double(i));
  const auto squares = [&](const Pose2& T) {
    double sum = 0.0;
    for (const auto& p : aligned(pairs, T)) sum += std::pow(distance(p.reference, p.estimate), 2);
    return sum;
  };
  const Pose2 best = rigid_alignment(pairs);
  for (const Pose2& d : {Pose2{1e-3, 0, 0}, Pose2{-1e-3, 0, 0}, Pose2{0, 1e-3, 0}, Pose2{0, -1e-3, 0},
                         Pose2{0, 0, 1e-3}, Pose2{0, 0, -1e-3}}) {
    EXPECT_LT(squares(best), squares({best.x + d.x, best.y + d.y, best.theta + d.theta}));
  }
}

TEST(RigidAlignment, OfOnePointOnlyShifts) {
  const std::vector<PosePair> pairs = {{Time{}, {2, 3, 1.0}, {1, 1, 0.0}}};
  expect_same(rigid_alignment(pairs), {1, 2, 0}, 1e-12);
  expect_same(rigid_alignment({}), {}, 0.0);
}

TEST(Alignment, NamesGoBothWays) {
  EXPECT_EQ(alignment_from_string(to_string(Alignment::kNone)), Alignment::kNone);
  EXPECT_EQ(alignment_from_string(to_string(Alignment::kRigid)), Alignment::kRigid);
  EXPECT_THROW(alignment_from_string("similarity"), ConfigurationError);
}

}  // namespace
}  // namespace cairn
