#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

namespace cairn {

/// The resampling wheel (Thrun, "Artificial Intelligence for Robotics", Udacity 2012): from a random place on
/// a wheel divided by the weights, ancestor after ancestor lies a random turn further, uniform in [0, twice
/// the largest weight].
///
/// The original begins at an index chosen without regard to the weights, which biases the first draws; this
/// one begins anywhere on the wheel, so that the counts have the right expectation. Going round once per turn
/// would cost O(N^2) where one weight is large; a table of N entries into the wheel (Chen & Asau 1974) finds
/// each place in constant expected time.
class WheelOfFortune final : public Resampling {
 public:
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override;

 private:
  void index(std::span<const double> cumulative);
  std::uint32_t find(std::span<const double> cumulative, double position) const;

  std::vector<std::uint32_t> entries_;  ///< scratch: the ancestor at k / N of the circumference
};

}  // namespace cairn
