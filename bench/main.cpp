#include "registration.hpp"

#include <cstdio>
#include <cstdlib>

namespace cairn::bench {

std::vector<SimdPath> paths_to_measure() {
  const char* limit = std::getenv("CAIRN_SIMD");
  const auto best = limit != nullptr ? simd_path_named(limit) : SimdPath::kAvx512;
  std::vector<SimdPath> paths;
  for (const SimdPath path : available_simd_paths()) {
    if (path <= best.value_or(SimdPath::kAvx512)) paths.push_back(path);
  }
  return paths;
}

}  // namespace cairn::bench

int main(int argc, char** argv) {
  using namespace cairn::bench;
  const char* limit = std::getenv("CAIRN_SIMD");
  if (limit != nullptr && !cairn::simd_path_named(limit)) {
    std::fprintf(stderr, "CAIRN_SIMD is '%s': use scalar, sse4, avx2 or avx512\n", limit);
    return 2;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::string paths;
  for (const cairn::SimdPath path : paths_to_measure())
    paths += (paths.empty() ? "" : " ") + std::string(name_of(path));
  benchmark::AddCustomContext("cairn_simd_paths", paths);
  register_maps();
  register_models();
  register_filter();
  register_peer();
  benchmark::RunSpecifiedBenchmarks();
}
