#pragma once

#include "cairn/core/normal3.hpp"
#include "cairn/core/rng.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// Three standard normal numbers for each item of a batch: what RandomStream::normal3 gives, exactly, on all
/// lanes of the processor.
///
/// A pure function of the item: batches of any size give the same numbers, and so does every path of
/// simd.hpp.
class Normal3Batch {
 public:
  static constexpr std::size_t kCapacity = Normal3::kGroup;

  /// Draws for `count` items, at most kCapacity. @pre their numbers stay below 2^32
  void fill(const RandomStream& random, std::uint32_t first, std::size_t count, std::uint16_t draw = 0);

  /// Number k of all items in units of Normal3::kUnit, the first one first; there are some more behind the
  /// last that hold anything.
  const std::int16_t* number(std::size_t k) const { return numbers_[k].data() + skipped_; }

 private:
  // Whole groups of items are drawn. A batch may begin within a group and end within the next; the last
  // vector may be read to its end.
  static constexpr std::size_t kLargestVector = 32;

  alignas(
      64) std::array<std::array<std::int16_t, std::size_t{2} * Normal3::kGroup + kLargestVector>, 3> numbers_;
  std::size_t skipped_ = 0;
};

}  // namespace cairn
