#pragma once

#include "cairn/core/rng.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// Standard normal numbers for a batch of items, computed on all lanes of the processor.
///
/// number[k][i] is what RandomStream::normal4(first + i, draw)[k] gives, in single precision: within
/// 2e-6 * (1 + |value|). A pure function of the item like that one: batches of any size give the same bits,
/// and so does every path of simd.hpp. About 1 ns per item with AVX2.
struct NormalBatch {
  static constexpr std::size_t kCapacity = 128;

  /// Fills the first `count` columns, at most kCapacity; those behind hold anything.
  void fill(const RandomStream& random, std::uint32_t first, std::size_t count, std::uint16_t draw = 0);

  alignas(64) std::array<std::array<float, kCapacity>, 4> number;
};

}  // namespace cairn
