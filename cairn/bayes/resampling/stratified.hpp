#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

namespace cairn {

/// Stratified resampling (Kitagawa 1996): one independent draw from each of `count` equal strata.
class Stratified final : public Resampling {
 public:
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override;
};

}  // namespace cairn
