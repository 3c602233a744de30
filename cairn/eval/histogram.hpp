#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// How many values lie in each of equally wide bins from 0 on: bin i holds [i, i + 1) times `width`.
struct Histogram {
  double width = 0.0;
  std::vector<std::int64_t> counts;
};

/// Bins of a round width (1, 2 or 5 times a power of ten), between 15 and 40 of them, that hold all `values`
/// (finite, not negative). No values: one empty bin; all zero: all in one bin.
Histogram make_histogram(std::span<const double> values);

}  // namespace cairn
