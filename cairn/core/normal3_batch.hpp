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
  static constexpr std::size_t kCapacity = std::size_t{4} * Normal3::kGroup;
  static constexpr std::size_t kMostGroups = kCapacity / Normal3::kGroup + 1;  ///< it may begin within one

  /// Whole groups of items are drawn. The last vector, of up to 32 numbers, may be read to its end.
  using Numbers = std::array<std::array<std::int16_t, kMostGroups * Normal3::kGroup + 32>, 3>;

  /// Draws for `count` items, at most kCapacity. @pre their numbers stay below 2^32
  void fill(const RandomStream& random, std::uint32_t first, std::size_t count, std::uint16_t draw = 0);

  /// Number k of all items in units of Normal3::kUnit, the first one first; there are some more behind the
  /// last that hold anything.
  const std::int16_t* number(std::size_t k) const { return numbers_[k].data() + skipped_; }

 private:
  alignas(64) Numbers numbers_;
  std::size_t skipped_ = 0;
};

}  // namespace cairn
