#include "cairn/bayes/injections/worse_than_usual.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

using Line = double;  ///< a position on a line

// As many beams as that, of which each has the likelihood 0.85 exp(-d^2 / (2 sigma^2)) + 0.15.
BoundUpdate<Line> scan(double beams, double sigma) {
  return {{}, [=](std::span<const Line> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i) {
              const double d = states[i] / sigma;
              out[i] = beams * std::log(0.85 * std::exp(-d * d / 2.0) + 0.15);
            }
          }};
}

WhileWorseThanUsual<Line> rule() {
  return {{.share = 0.5, .averages = {}, .nowhere = 1e9, .least = 0.15},
          std::make_unique<NewFromMeasurement<Line>>(nullptr)};
}

// KLD-sampling changes the size from step to step; a tracked robot needs no samples of p(x | z) for that.
TEST(WhileWorseThanUsual, ReplacesTheGrowthOnlyWhereTheMeasurementsHaveBecomeWorse) {
  auto growing = rule();
  const auto z = scan(10.0, 1.0);
  const double good = 10.0 * std::log(0.8), bad = 10.0 * std::log(0.15);
  std::size_t particles = 500;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(growing.wanted(z, good, particles += 50), 0u);
  int until = 0;  // w_fast after n bad ones: 0.65 * 0.8^n + 0.15, below half of 0.8 where n is 5
  while (growing.wanted(z, bad, particles += 50) == 0u && until < 100) ++until;
  EXPECT_EQ(until, 4);
  EXPECT_EQ(growing.wanted(z, bad, particles += 30), 30u);
  for (int i = 0; i < 3; ++i) growing.wanted(z, good, particles);
  EXPECT_EQ(growing.wanted(z, good, particles += 50), 0u);  // all is well again
}

// A belief over several places is weighed by few wide beams: that is no change.
TEST(WhileWorseThanUsual, SharpAndWideLikelihoodsOfAScanAreComparable) {
  auto growing = rule();
  std::size_t particles = 500;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(growing.wanted(scan(20.0, 0.05), 20.0 * std::log(0.7), particles += 50), 0u);
    EXPECT_EQ(growing.wanted(scan(6.0, 0.2), 6.0 * std::log(0.7), particles += 50), 0u);
  }
  for (int i = 0; i < 8; ++i) growing.wanted(scan(6.0, 0.2), 6.0 * std::log(0.15), particles);
  EXPECT_EQ(growing.wanted(scan(6.0, 0.2), 6.0 * std::log(0.15), particles + 50), 50u);
}

TEST(WhileWorseThanUsual, ItsAveragesComeBack) {
  auto one = rule(), other = rule();
  const auto z = scan(10.0, 1.0);
  for (int i = 0; i < 5; ++i) one.wanted(z, -1.0, 500);
  for (int i = 0; i < 10; ++i) one.wanted(z, -19.0, 500);
  PartMemory memory;
  one.save(memory);
  PartMemory::Reader reader(memory);
  other.load(reader);
  EXPECT_EQ(other.wanted(z, -19.0, 600), 100u);
  EXPECT_EQ(one.wanted(z, -19.0, 600), 100u);
}

}  // namespace
}  // namespace cairn
