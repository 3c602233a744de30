#include "cairn/bayes/injections/measurement_source.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace cairn {
namespace {

/// Draws a constant.
class Constant final : public SampleFrom<double> {
 public:
  void sample(const BoundUpdate<double>& /*z*/, std::span<double> states,
              const RandomStream& /*random*/) const override {
    std::fill(states.begin(), states.end(), -1.0);
  }
};

const RandomStream kRandom(1, RandomPurpose::kInitialize, 0);

TEST(MeasurementSource, DrawsFromTheMeasurementThatCanBeDrawnFrom) {
  const MeasurementSource<double> source(std::make_unique<const Constant>());
  BoundUpdate<double> z;
  z.sample = [](const RandomStream& random, std::span<double> states) {
    for (std::uint32_t i = 0; i < states.size(); ++i) states[i] = random.uniform4(i)[0];
  };
  std::array<double, 8> states{};
  source.sample(z, states, kRandom);
  for (std::uint32_t i = 0; i < states.size(); ++i) EXPECT_EQ(states[i], kRandom.uniform4(i)[0]);
}

TEST(MeasurementSource, DrawsFromTheOtherSourceElse) {
  const MeasurementSource<double> source(std::make_unique<const Constant>());
  std::array<double, 3> states{};
  source.sample({}, states, kRandom);
  EXPECT_EQ(states, (std::array{-1.0, -1.0, -1.0}));
}

}  // namespace
}  // namespace cairn
