#pragma once

#include "cairn/eval/bootstrap.hpp"

#include <span>

namespace cairn {

/// How two ways of doing the same things differ.
struct PairedComparison {
  MeanInterval difference;  ///< of b - a: below 0 where b is less
  /// Two-sided p-value of "there is no difference": the share of all ways to swap a and b within the pairs in
  /// which the mean difference is at least as far from 0 (Fisher's sign-flip test). All 2^n ways up to n =
  /// 14; beyond, `resamples` drawn ones, with (k + 1) / (resamples + 1). 1 for no pairs.
  double p_value = 1.0;
};

/// Compares a[i] with b[i]: what was measured on the same input with the same seed. What makes one input
/// harder than another falls out of the differences.
/// @throws std::logic_error unless both have the same size
PairedComparison compare_paired(std::span<const double> a, std::span<const double> b,
                                const BootstrapOptions& options = {});

}  // namespace cairn
