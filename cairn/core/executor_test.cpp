#include "cairn/core/executor.hpp"

#include "cairn/core/errors.hpp"

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using Chunks = std::multiset<std::pair<std::size_t, std::size_t>>;

Chunks chunks_of(int threads, std::size_t items, std::size_t chunk) {
  std::mutex mutex;
  Chunks chunks;
  Executor(threads).for_each_chunk(items, chunk, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    chunks.insert({begin, end});
  });
  return chunks;
}

TEST(Executor, ChunksDoNotDependOnTheThreads) {
  const Chunks expected = {{0, 4}, {4, 8}, {8, 10}};
  for (const int threads : {1, 2, 7}) EXPECT_EQ(chunks_of(threads, 10, 4), expected) << threads;
}

TEST(Executor, EdgesOfTheNumberOfItems) {
  for (const int threads : {1, 2, 7}) {
    EXPECT_EQ(chunks_of(threads, 0, 4), Chunks{});
    EXPECT_EQ(chunks_of(threads, 1, 4), (Chunks{{0, 1}}));
    EXPECT_EQ(chunks_of(threads, 4, 4), (Chunks{{0, 4}}));
    EXPECT_EQ(chunks_of(threads, 5, 4), (Chunks{{0, 4}, {4, 5}}));
  }
}

TEST(Executor, EveryItemOnce) {
  for (const int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> visits(100'003);
    Executor(threads).for_each_chunk(visits.size(), 17, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& n : visits) ASSERT_EQ(n, 1);
  }
}

TEST(Executor, AnExceptionReachesTheCaller) {
  for (const int threads : {1, 2, 7}) {
    const Executor executor(threads);
    const auto fail = [](std::size_t begin, std::size_t) {
      if (begin == 8) throw std::runtime_error("chunk 2");
    };
    EXPECT_THROW(executor.for_each_chunk(100, 4, fail), std::runtime_error) << threads;
    std::atomic<int> chunks = 0;  // and the executor still works
    executor.for_each_chunk(100, 4, [&](std::size_t, std::size_t) { ++chunks; });
    EXPECT_EQ(chunks, 25);
  }
}

TEST(Executor, CanBeUsedFromWithinItself) {
  const Executor executor(2);
  std::atomic<int> inner = 0;
  executor.for_each_chunk(8, 1, [&](std::size_t, std::size_t) {
    executor.for_each_chunk(8, 1, [&](std::size_t, std::size_t) { ++inner; });
  });
  EXPECT_EQ(inner, 64);
}

TEST(Executor, RefusesLessThanOneThread) {
  EXPECT_THROW(Executor(0), ConfigurationError);
  EXPECT_THROW(Executor(-3), ConfigurationError);
  EXPECT_EQ(Executor(7).threads(), 7);
  EXPECT_EQ(Executor().threads(), 1);
}

TEST(Executor, AChunkOfNothingIsABug) {
  EXPECT_THROW(Executor(1).for_each_chunk(10, 0, [](std::size_t, std::size_t) {}), std::logic_error);
}

TEST(Executor, RefusesNumbersOfThreadsThatNoMachineHas) {
  for (const int threads : {-1, 0, Executor::kMostThreads + 1, 100'000}) {
    EXPECT_THROW(Executor{threads}, ConfigurationError) << threads;
  }
}

}  // namespace
}  // namespace cairn
