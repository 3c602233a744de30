#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cairn {

/// Where 4 x 4 neighbouring bytes lie in a plane whose rows come in fours: byte (column, row) at
/// (row / 4) * row_step + 4 * column + row % 4. Any block is part of two such bands, sixteen bytes of each.
struct BlockPlace {
  const std::uint8_t* band = nullptr;  ///< where the block's first column begins in its lower band
  std::size_t row_step = 0;            ///< from there to the band above
  unsigned skipped = 0;                ///< rows of the lower band that are below the block, 0 to 3

  std::uint8_t at(std::size_t column, std::size_t row) const {
    const std::size_t from_band = skipped + row;
    return band[from_band / 4 * row_step + 4 * column + from_band % 4];
  }
};

/// Sums of 4 x 4 bytes, place by place, over many places of a plane. Sixteen sums cost little more than one,
/// for two accesses of the memory bring all of them; the bytes are added as 16-bit lanes, the same on any
/// machine.
class BlockSums {
 public:
  using Sums = std::array<std::uint32_t, 16>;

  void add(const BlockPlace& place) {
    if (added_ == kMostBeforeOverflow) carry();
    ++added_;
    Columns lower, upper;
    std::memcpy(&lower, place.band, sizeof lower);
    std::memcpy(&upper, place.band + place.row_step, sizeof upper);
    const unsigned bits = 8 * place.skipped;
    const auto rows = std::bit_cast<Lanes>(lower >> bits | upper << 8 << (24 - bits));
    even_ += rows & 0xFF;
    odd_ += rows >> 8;
  }

  /// Of place (column, row): sums()[4 row + column].
  const Sums& sums() {
    carry();
    return sums_;
  }

 private:
  static_assert(std::endian::native == std::endian::little);
  static constexpr int kMostBeforeOverflow = 257;  // 257 x 255 < 2^16

  // Extension of GCC and Clang: as wide as the registers that every x86-64 and ARM64 has.
  using Columns = std::uint32_t __attribute__((vector_size(16)));  ///< four rows of each
  using Lanes = std::uint16_t __attribute__((vector_size(16)));    ///< two of a column

  void carry() {
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const std::size_t column = lane / 2, row = lane % 2 * 2;
      sums_[4 * row + column] += even_[lane];
      sums_[4 * (row + 1) + column] += odd_[lane];
    }
    even_ = odd_ = Lanes{};
    added_ = 0;
  }

  Lanes even_{}, odd_{};  ///< rows 0 and 2, rows 1 and 3 of the columns
  int added_ = 0;
  Sums sums_{};
};

}  // namespace cairn
