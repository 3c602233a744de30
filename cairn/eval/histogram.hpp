#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// How many values lie in each of equally wide bins from 0 on: bin i holds [i, i + 1) times `width`.
struct Histogram {
  double width = 0.0;
  std::vector<std::int64_t> counts;
  std::int64_t beyond = 0;  ///< values above the last bin
};

/// Bins of a round width (1, 2 or 5 times a power of ten), at most 40, that reach to the 99th percentile: a
/// few far values must not press all others into one bin, so they are only counted. `values` are finite and
/// not negative. No values: one empty bin; all zero: all in one bin.
Histogram make_histogram(std::span<const double> values);

}  // namespace cairn
