#include "cairn/io/carmen_log.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/rosbag1.hpp"
#include "test_data.hpp"

#include <benchmark/benchmark.h>

namespace {

// Unpacking included; items are events.
template <class Read>
void read_log(benchmark::State& state, const char* recording, Read read) {
  const auto path = cairn::test::data_file(recording);
  if (path.empty()) return state.SkipWithError("this machine has not the recording");
  std::int64_t events = 0;
  for (auto _ : state) {
    const auto input = cairn::open_input(path);
    events += static_cast<std::int64_t>(read(*input, "bench").events.size());
  }
  state.SetItemsProcessed(events);
}

// The readers have no peer.
BENCHMARK_CAPTURE(read_log, intel, "radish_raw/intel.clf.bz2", cairn::read_carmen_log)
    ->Name("cairn/read/intel.clf.bz2")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_log, jarvis, "jarvis_nav350/jarvis_complex_path_fast.bag", cairn::read_rosbag1)
    ->Name("cairn/read/jarvis.bag")
    ->Unit(benchmark::kMillisecond);

}  // namespace
