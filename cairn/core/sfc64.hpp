#pragma once

#include <bit>
#include <cstdint>

namespace cairn {

/// sfc64, "small fast counting", by Chris Doty-Humphrey (PractRand 0.94, RNGs/sfc): 64 random bits from four
/// additions, two shifts, a rotation and an exclusive or. Its counter makes every period at least 2^64.
///
/// It has a state to advance and is used where many bits are wanted from one place: three words of a keyed
/// generator are its start, so that it needs no rounds before the first number.
struct Sfc64 {
  std::uint64_t a, b, c;
  std::uint64_t counter = 1;

  static constexpr int kRotation = 24, kRight = 11, kLeft = 3;

  constexpr std::uint64_t next() {
    const std::uint64_t number = a + b + counter++;
    a = b ^ (b >> kRight);
    b = c + (c << kLeft);
    c = std::rotl(c, kRotation) + number;
    return number;
  }
};

}  // namespace cairn
