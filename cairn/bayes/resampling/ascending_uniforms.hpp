#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// `count` independent uniform numbers in ascending order, one by one, without sorting or storing them: the
/// least of n uniform numbers is 1 - u^(1/n) (Bentley & Saxe, "Generating sorted lists of random numbers",
/// ACM Trans. Math. Softw. 1980).
class AscendingUniforms {
 public:
  AscendingUniforms(std::size_t count, const DrawingNumbers& numbers) : left_(count), numbers_(numbers) {}

  /// @pre called at most `count` times
  double next() {
    log_above_ += std::log(numbers_.of_particle(item_++)) / static_cast<double>(left_--);
    return -std::expm1(log_above_);
  }

 private:
  std::size_t left_;
  std::uint32_t item_ = 0;
  double log_above_ = 0.0;  ///< log(1 - last number)
  const DrawingNumbers& numbers_;
};

}  // namespace cairn
