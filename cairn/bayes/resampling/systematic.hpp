#pragma once

#include "cairn/bayes/resampling/cumulative_weights.hpp"
#include "cairn/bayes/resampling/resampling.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// Appends to `ancestors` the indices under a comb of `count` equally spaced teeth whose first lies at
/// `offset` (0..1) of the spacing. Each index is drawn within 1 of count * w_i times. O(N + count).
void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors);

/// Systematic resampling (Kitagawa 1996; Thrun et al., Probabilistic Robotics, table 4.4): one comb at a
/// random offset. A single random number decides.
class Systematic final : public Resampling {
 public:
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override {
    draw_systematic(cumulative, count, numbers.single(), ancestors);
  }
};

}  // namespace cairn
