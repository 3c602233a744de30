#pragma once

#include "cairn/core/simd.hpp"

namespace cairn::test {

/// Calls `check(path)` with each path that this machine has in use, the slowest first; all are free again
/// after.
template <class Check>
void on_every_simd_path(const Check& check) {
  for (const SimdPath path : available_simd_paths()) {
    limit_simd_path(path);
    check(path);
  }
  limit_simd_path(SimdPath::kAvx512);
}

}  // namespace cairn::test
