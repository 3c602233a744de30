#pragma once

#include "cairn/core/simd.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace cairn::bench {

using Benchmark = std::function<void(benchmark::State&)>;

/// Registers `cairn/KERNEL/PATH/N` for every path and N: what is compared with `mrpt/KERNEL/N`.
inline void on_paths(const std::string& kernel, const std::vector<SimdPath>& paths,
                     const std::vector<std::int64_t>& sizes, const Benchmark& run) {
  for (const SimdPath path : paths) {
    const auto limited = [path, run](benchmark::State& state) {
      limit_simd_path(path);
      run(state);
      limit_simd_path(SimdPath::kAvx512);
    };
    const std::string name = "cairn/" + kernel + "/" + std::string(name_of(path));
    for (const std::int64_t n : sizes)
      benchmark::RegisterBenchmark(name.c_str(), limited)->Arg(n)->Unit(benchmark::kMicrosecond);
  }
}

/// All paths of this machine up to the limit of CAIRN_SIMD, if that is set.
std::vector<SimdPath> paths_to_measure();

inline void of_peer(const std::string& kernel, const std::vector<std::int64_t>& sizes, const Benchmark& run) {
  for (const std::int64_t n : sizes) {
    const std::string name = "mrpt/" + kernel;
    benchmark::RegisterBenchmark(name.c_str(), run)->Arg(n)->Unit(benchmark::kMicrosecond);
  }
}

void register_maps();
void register_models();
void register_filter();
void register_peer();  ///< does nothing where MRPT is not installed

}  // namespace cairn::bench
