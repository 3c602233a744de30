#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

namespace cairn {

/// Multinomial resampling (Gordon, Salmond & Smith, IEE Proc. F 1993): each ancestor is drawn independently
/// of the others; a count has variance count * w_i (1 - w_i), the largest of all schemes.
class Multinomial final : public Resampling {
 public:
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override;
};

}  // namespace cairn
