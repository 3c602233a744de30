#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn {

/// Finds the indices under positions that ascend from 0 to 1, on the line that the cumulative weights divide.
/// An index without weight is never found. A walk from one end to the other is O(N).
class AncestorSearch {
 public:
  explicit AncestorSearch(std::span<const double> cumulative) : cumulative_(cumulative) {}

  /// @pre not below the last position
  std::uint32_t at(double position) {
    position = std::min(position, kLargestPosition);
    while (cumulative_[i_] <= position) ++i_;
    return static_cast<std::uint32_t>(i_);
  }

  /// Positions may round up to 1, where no index lies.
  static constexpr double kLargestPosition = 1.0 - 0x1p-53;

 private:
  std::span<const double> cumulative_;
  std::size_t i_ = 0;
};

}  // namespace cairn
