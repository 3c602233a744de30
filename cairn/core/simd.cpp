#include "cairn/core/simd.hpp"

#include <array>
#include <cstdint>

#include <hwy/highway.h>

namespace cairn {
namespace {

struct Named {
  SimdPath path;
  std::string_view name;
  std::int64_t targets;  ///< Highway's bits of this path
};

constexpr std::array kPaths = {
#if HWY_ARCH_X86
    Named{SimdPath::kScalar, "scalar", HWY_SCALAR | HWY_EMU128},
    Named{SimdPath::kSse4, "sse4", HWY_SSE4},
    Named{SimdPath::kAvx2, "avx2", HWY_AVX2},
    Named{SimdPath::kAvx512, "avx512", HWY_AVX3 | HWY_AVX3_DL},
#else
    Named{SimdPath::kScalar, "scalar", HWY_STATIC_TARGET},
#endif
};

bool is_supported(const Named& path, std::int64_t supported) {
  return path.path == SimdPath::kScalar || (path.targets & supported) != 0;
}

SimdPath best_of(std::int64_t supported) {
  SimdPath best = SimdPath::kScalar;
  for (const Named& path : kPaths) {
    if (is_supported(path, supported)) best = path.path;
  }
  return best;
}

// What the machine can do, asked once: limits come later.
std::int64_t targets_of_machine() {
  static const std::int64_t targets = hwy::SupportedTargets();
  return targets;
}

}  // namespace

std::string_view name_of(SimdPath path) {
  for (const Named& p : kPaths) {
    if (p.path == path) return p.name;
  }
  return "none of this machine";
}

std::optional<SimdPath> simd_path_named(std::string_view name) {
  for (const Named& path : kPaths) {
    if (path.name == name) return path.path;
  }
  return std::nullopt;
}

SimdPath simd_path() { return best_of(hwy::SupportedTargets()); }

std::vector<SimdPath> available_simd_paths() {
  std::vector<SimdPath> available;
  for (const Named& path : kPaths) {
    if (is_supported(path, targets_of_machine())) available.push_back(path.path);
  }
  return available;
}

void limit_simd_path(SimdPath best) {
  targets_of_machine();
  std::int64_t disabled = 0;
  for (const Named& path : kPaths) disabled |= path.path > best ? path.targets : 0;
  hwy::DisableTargets(disabled);
}

}  // namespace cairn
