#pragma once

#include "cairn/core/rng.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// Three standard normal numbers for each item of a batch: what RandomStream::normal3 gives, in single
/// precision on all lanes of the processor, within 5e-5 * (1 + |value|).
///
/// A pure function of the item: batches of any size give the same bits, and so does every path of simd.hpp.
class Normal3Batch {
 public:
  static constexpr std::size_t kCapacity = 128;

  /// Draws for `count` items, at most kCapacity. @pre their numbers stay below 2^32
  void fill(const RandomStream& random, std::uint32_t first, std::size_t count, std::uint16_t draw = 0);

  /// Number k of all items, the first one first; there are some more behind the last that hold anything.
  const float* number(std::size_t k) const { return numbers_[k].data() + skipped_; }

 private:
  // Whole groups of items are drawn. A batch may begin within a group and end within another; the last vector
  // may be read to its end.
  static constexpr std::size_t kGroup = RandomStream::kNormal3Group;
  static constexpr std::size_t kDrawn = kCapacity + kGroup;
  static constexpr std::size_t kLargestVector = 16;

  alignas(64) std::array<std::array<float, kDrawn + kLargestVector>, 3> numbers_;
  std::size_t skipped_ = 0;
};

}  // namespace cairn
