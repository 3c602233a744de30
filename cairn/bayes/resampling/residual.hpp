#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

namespace cairn {

/// Residual resampling (Liu & Chen, JASA 1998): index i is taken floor(count * w_i) times for certain; what
/// remains is drawn multinomially by the fractions that are left.
class Residual final : public Resampling {
 public:
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override;
};

}  // namespace cairn
