#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cairn {

/// Sums of 4 x 4 bytes, place by place, over many places of a plane: four rows of four neighbours each time.
/// Sixteen sums cost little more than one, for the neighbours come with one access of the memory; the bytes
/// are added as 16-bit lanes of whole words, the same on any machine.
class BlockSums {
 public:
  using Sums = std::array<std::uint32_t, 16>;

  void add(const std::uint8_t* block, std::size_t row_step) {
    if (added_ == kMostBeforeOverflow) carry();
    ++added_;
    const std::uint64_t lower = word(block) | word(block + row_step) << 32;
    const std::uint64_t upper = word(block + 2 * row_step) | word(block + 3 * row_step) << 32;
    lanes_[0] += lower & kEven;
    lanes_[1] += lower >> 8 & kEven;
    lanes_[2] += upper & kEven;
    lanes_[3] += upper >> 8 & kEven;
  }

  /// Of place (column, row): sums()[4 row + column].
  const Sums& sums() {
    carry();
    return sums_;
  }

 private:
  static_assert(std::endian::native == std::endian::little);
  static constexpr std::uint64_t kEven = 0x00FF00FF00FF00FF;
  static constexpr int kMostBeforeOverflow = 257;  // 257 x 255 < 2^16

  static std::uint64_t word(const std::uint8_t* bytes) {
    std::uint32_t four;
    std::memcpy(&four, bytes, sizeof four);
    return four;
  }

  std::uint32_t lane_of(std::size_t word, std::size_t lane) const {
    return static_cast<std::uint32_t>(lanes_[word] >> (16 * lane) & 0xFFFF);
  }

  void carry() {
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t lane = 0; lane < 4; ++lane) {
        sums_[8 * half + 2 * lane] += lane_of(2 * half, lane);
        sums_[8 * half + 2 * lane + 1] += lane_of(2 * half + 1, lane);
      }
    }
    lanes_ = {};
    added_ = 0;
  }

  std::array<std::uint64_t, 4> lanes_{};  ///< even and odd columns of the lower rows, likewise of the upper
  int added_ = 0;
  Sums sums_{};
};

}  // namespace cairn
