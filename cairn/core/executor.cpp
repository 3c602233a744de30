#include "cairn/core/executor.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <atomic>
#include <string>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace cairn {

struct Executor::Pool {
  // The arena limits how many threads take part; the control lets there be more of them than cores, so that
  // "7 threads" really are seven in a test on two cores.
  explicit Pool(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads) {}
  tbb::global_control control;
  tbb::task_arena arena;
};

Executor::Executor(int threads) : threads_(threads) {
  if (threads < 1 || threads > kMostThreads) {
    throw ConfigurationError("threads", "is " + std::to_string(threads),
                             "use 1 to " + std::to_string(kMostThreads));
  }
  if (threads > 1) pool_ = std::make_unique<Pool>(threads);
}

Executor::~Executor() = default;

void Executor::for_each_chunk(std::size_t items, std::size_t chunk,
                              const std::function<void(std::size_t, std::size_t)>& work) const {
  CAIRN_ASSERT(chunk > 0);
  const auto run = [&](std::size_t begin) { work(begin, std::min(begin + chunk, items)); };
  if (!pool_ || items <= chunk) {
    for (std::size_t begin = 0; begin < items; begin += chunk) run(begin);
    return;
  }
  const std::size_t chunks = (items + chunk - 1) / chunk;
  // TBB orders what comes before, within and after the loop. ThreadSanitizer does not see that, as Debian's
  // TBB is not built for it: so it is said once more.
  std::atomic<std::size_t> done{0};
  done.store(0, std::memory_order_release);
  const auto run_in_order = [&](std::size_t i) {
    static_cast<void>(done.load(std::memory_order_acquire));
    run(i * chunk);
    done.fetch_add(1, std::memory_order_release);
  };
  pool_->arena.execute([&] { tbb::parallel_for(std::size_t{0}, chunks, run_in_order); });
  CAIRN_ASSERT(done.load(std::memory_order_acquire) == chunks);
}

}  // namespace cairn
