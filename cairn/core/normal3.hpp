#pragma once

#include "cairn/core/rng.hpp"
#include "cairn/core/sfc64.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// How RandomStream::normal3 makes a normal number of 24 random bits: the sum of five numbers, each picked by
/// four bits from a table of sixteen, plus four bits of fraction.
///
/// The numbers lie 16 kUnit apart, 1/420 standard deviation. The tables were searched for normal sums: 4th,
/// 6th and 8th moment within 4e-5, 2e-3 and 9e-3 of 3, 15 and 105, the distribution function between numbers
/// within 1e-4 (normal3_test.cpp adds up all cases). Tails are lighter from 4 standard deviations on: 0.91 of
/// what should lie beyond 4, 0.56 beyond 4.5, none beyond 4.84 (where one in 770,000 would).
struct Normal3 {
  using Table = std::array<std::int8_t, 16>;
  static constexpr std::array<Table, 5> kTables = {{
      {-28, -18, -14, -13, -9, -6, -2, -1, 0, 1, 5, 8, 12, 13, 17, 27},
      {-23, -4, -3, -2, -1, -1, 0, 0, 0, 0, 1, 1, 2, 3, 4, 23},
      {-21, -12, -9, -7, -5, -4, -3, -2, 2, 3, 4, 5, 7, 9, 12, 21},
      {-29, -23, -13, -12, -10, -8, -5, -2, 2, 5, 8, 10, 12, 13, 23, 29},
      {-26, -6, -6, -5, -4, -2, -1, 0, 0, 1, 2, 4, 5, 6, 6, 26},
  }};
  static constexpr double kUnit = 1.0 / (256.0 * 26.233718909306397);

  /// A normal number in units of kUnit, symmetric about zero.
  static constexpr std::int16_t from_bytes(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const int sum = kTables[0][a & 15] + kTables[1][a >> 4] + kTables[2][b & 15] + kTables[3][b >> 4] +
                    kTables[4][c & 15];
    return static_cast<std::int16_t>(sum * 256 + (c & 0xf0) + 8);
  }

  /// Items come in groups of 128. A group's bytes are nine rows of 128, three rows (a, b, c) for each of the
  /// three numbers, and two numbers each of eight generators side by side.
  static constexpr std::uint32_t kGroup = 128;
  static constexpr std::size_t kBytes = std::size_t{9} * kGroup;
  static constexpr std::size_t kGenerators = 8, kSteps = kBytes / (8 * kGenerators);

  /// The generators of a group start with twelve blocks of Philox4x32-7.
  static constexpr std::uint32_t kBlocks = 12;
  static constexpr Sfc64 generator(const std::array<PhiloxCounter, kBlocks>& blocks, std::size_t g) {
    const PhiloxCounter& shared = blocks[kGenerators + g % 4];
    return {pair(blocks[g], 0), pair(blocks[g], 2), pair(shared, g < 4 ? 0 : 2)};
  }

  /// The place in a row of an item of the group: sixteen bytes give the numbers of eight items of the first
  /// half, then of eight of the second (they leave a vector of bytes that way).
  static constexpr std::size_t column_of(std::size_t item) {
    return item % 64 / 8 * 16 + item / 64 * 8 + item % 8;
  }

  /// Where byte k of a group comes from.
  struct Place {
    std::size_t step, generator;
    int shift;
  };
  static constexpr Place place_of(std::size_t k) {
    return {k / (8 * kGenerators), k / 8 % kGenerators, static_cast<int>(k % 8 * 8)};
  }

 private:
  // Words k + 1 and k of a block: as the lanes leave them.
  static constexpr std::uint64_t pair(const PhiloxCounter& block, std::size_t k) {
    return std::uint64_t{block[k]} << 32 | block[k + 1];
  }
};

}  // namespace cairn
