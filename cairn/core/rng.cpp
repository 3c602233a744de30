#include "cairn/core/rng.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

#include <Random123/philox.h>

namespace cairn {
namespace {

constexpr double kScale = 0x1p-32;

// (0, 1): the middle of the word's interval, so that log() is finite and the mean is exactly 1/2.
double to_uniform(std::uint32_t word) { return (static_cast<double>(word) + 0.5) * kScale; }

struct NormalPair {
  double first;
  double second;
};

NormalPair box_muller(double u, double v) {
  const double radius = std::sqrt(-2.0 * std::log(u));
  return {radius * std::cos(kTwoPi * v), radius * std::sin(kTwoPi * v)};
}

// The radius from bits 10 to 29, the place within a quadrant from bits 0 to 9, the signs from bits 31 and 30.
NormalPair box_muller(std::uint32_t word) {
  const double radius = std::sqrt(-2.0 * std::log(((word >> 10 & 0xfffffu) + 0.5) * 0x1p-20));
  const double angle = ((word & 0x3ffu) + 0.5) / 1024.0 * (kPi / 2.0);
  const double first = radius * std::cos(angle), second = radius * std::sin(angle);
  return {(word & 0x80000000u) != 0 ? -first : first, (word & 0x40000000u) != 0 ? -second : second};
}

}  // namespace

PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key) {
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k = {{key[0], key[1]}};
  const auto words = r123::Philox4x32()(c, k);
  return {words[0], words[1], words[2], words[3]};
}

RandomStream RandomStream::from_item(std::uint32_t first) const {
  RandomStream moved = *this;
  moved.first_item_ += first;
  return moved;
}

PhiloxCounter RandomStream::counter(std::uint32_t item, std::uint16_t draw) const {
  const auto purpose = static_cast<std::uint32_t>(purpose_);
  return {first_item_ + item, (purpose << 16) | draw, static_cast<std::uint32_t>(step_),
          static_cast<std::uint32_t>(step_ >> 32)};
}

std::array<double, 4> RandomStream::uniform4(std::uint32_t item, std::uint16_t draw) const {
  const PhiloxCounter words = philox4x32_10(counter(item, draw), key());
  return {to_uniform(words[0]), to_uniform(words[1]), to_uniform(words[2]), to_uniform(words[3])};
}

std::array<double, 4> RandomStream::normal4(std::uint32_t item, std::uint16_t draw) const {
  const auto u = uniform4(item, draw);
  const NormalPair a = box_muller(u[0], u[1]);
  const NormalPair b = box_muller(u[2], u[3]);
  return {a.first, a.second, b.first, b.second};
}

std::array<double, 3> RandomStream::normal3(std::uint32_t item, std::uint16_t draw) const {
  constexpr std::uint32_t kHalf = kNormal3Group / 2;
  PhiloxCounter pairs = counter(item, draw), thirds = counter(item, static_cast<std::uint16_t>(draw + 1));
  const std::uint32_t i = pairs[0], group = i / kNormal3Group, in_half = i % kHalf;
  pairs[0] = i / 4;
  thirds[0] = group * (kHalf / 4) + in_half / 4;
  const NormalPair pair = box_muller(philox4x32_10(pairs, key())[i % 4]);
  const NormalPair third = box_muller(philox4x32_10(thirds, key())[in_half % 4]);
  return {pair.first, pair.second, i % kNormal3Group < kHalf ? third.first : third.second};
}

}  // namespace cairn
