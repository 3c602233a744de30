#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace cairn {

/// Sets of instructions for which the hot kernels are compiled, the slowest first. The best that the machine
/// has is chosen at run time (Highway). The kernels use no fused multiply-add and add in a fixed order: every
/// path gives the same bytes, so a path is a matter of speed alone.
enum class SimdPath { kScalar, kSse4, kAvx2, kAvx512 };

/// `scalar`, `sse4`, `avx2`, `avx512`: what every machine of the kind has, and 16, 32, 64 bytes at once.
std::string_view name_of(SimdPath path);
std::optional<SimdPath> simd_path_named(std::string_view name);

/// The path in use.
SimdPath simd_path();

/// Those that this machine can run, the slowest first.
std::vector<SimdPath> available_simd_paths();

/// From now on the whole process uses no better path than this one: for tests and benchmarks. Not to be
/// called while another thread computes.
void limit_simd_path(SimdPath best);

}  // namespace cairn
