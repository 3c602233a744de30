#pragma once

#include <array>
#include <cstdint>

namespace cairn {

/// Four 32-bit words of Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC
/// 2011).
using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;
PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key);

/// Seven rounds: the fewest that pass all of BigCrush (the same paper, table 2).
PhiloxCounter philox4x32_7(PhiloxCounter counter, PhiloxKey key);

/// What a random number is for. Numbers of different purposes are independent; the values are part of the
/// recorded results, so entries are only ever appended.
enum class RandomPurpose : std::uint16_t {
  kInitialize = 0,
  kMotion = 1,
  kResample = 2,
  kSimulation = 3,
  kTest = 4,
  kRegularize = 5,
  kCandidates = 6,
  kRefine = 7,
  kInject = 8,
  kEvaluation = 9,
};

/// Random numbers as a pure function of (seed, purpose, step, item, draw).
///
/// There is no state to advance: particle 17 of step 4 gets the same numbers whichever thread asks, in
/// whatever order. `item` is the particle (beam, object ...), `draw` tells several blocks for one item apart.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t step)
      : seed_(seed), step_(step), purpose_(purpose) {}

  /// The same stream with its items counted from `first`: for a chunk of a larger batch.
  RandomStream from_item(std::uint32_t first) const;

  /// Four uniform numbers in (0, 1), 32 bits each.
  std::array<double, 4> uniform4(std::uint32_t item, std::uint16_t draw = 0) const;
  double uniform(std::uint32_t item, std::uint16_t draw = 0) const { return uniform4(item, draw)[0]; }

  /// Four independent standard normal numbers (Box-Muller; at most 6.8 standard deviations).
  std::array<double, 4> normal4(std::uint32_t item, std::uint16_t draw = 0) const;

  /// Three independent standard normal numbers, from 24 random bits each (see Normal3): in batches
  /// (Normal3Batch) for a fraction of the price of normal4. Blocks are shared by the items of a group: a
  /// stream gives either these or the numbers above for a draw, not both.
  std::array<double, 3> normal3(std::uint32_t item, std::uint16_t draw = 0) const;

  /// Where the words of an item come from: those of the next item have the next counter[0] (modulo 2^32).
  PhiloxCounter counter(std::uint32_t item, std::uint16_t draw = 0) const;
  PhiloxKey key() const {
    return {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t step_;
  RandomPurpose purpose_;
  std::uint32_t first_item_ = 0;
};

}  // namespace cairn
