#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace cairn {

/// Runs a loop over fixed chunks on a given number of threads.
///
/// The chunks depend on the number of items alone, never on the threads: whatever a chunk computes and writes
/// to its own place is the same for any number of threads.
class Executor {
 public:
  static constexpr int kMostThreads = 256;

  /// @param threads 1 runs in the caller; more uses a pool of that size.
  /// @throws ConfigurationError below 1 and beyond kMostThreads
  explicit Executor(int threads = 1);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int threads() const { return threads_; }

  /// Calls `work(begin, end)` for [0, chunk), [chunk, 2 chunk) ... up to `items`; returns when all are done.
  void for_each_chunk(std::size_t items, std::size_t chunk,
                      const std::function<void(std::size_t, std::size_t)>& work) const;

 private:
  struct Pool;
  int threads_;
  std::unique_ptr<Pool> pool_;
};

}  // namespace cairn
