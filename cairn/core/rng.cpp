#include "cairn/core/rng.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/normal3.hpp"

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

}  // namespace

PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key) {
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k = {{key[0], key[1]}};
  const auto words = r123::Philox4x32()(c, k);
  return {words[0], words[1], words[2], words[3]};
}

PhiloxCounter philox4x32_7(PhiloxCounter counter, PhiloxKey key) {
  const r123::Philox4x32_R<7>::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32_R<7>::key_type k = {{key[0], key[1]}};
  const auto words = r123::Philox4x32_R<7>()(c, k);
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
  PhiloxCounter first = counter(item, draw);
  const std::size_t column = Normal3::column_of(first[0] % Normal3::kGroup);
  first[0] = first[0] / Normal3::kGroup * Normal3::kBlocks;
  std::array<PhiloxCounter, Normal3::kBlocks> blocks;
  for (PhiloxCounter& block : blocks) block = philox4x32_7(first, key()), ++first[0];

  // All bytes of an item come from one generator.
  Sfc64 generator = Normal3::generator(blocks, Normal3::place_of(column).generator);
  std::array<std::uint64_t, Normal3::kSteps> words;
  for (std::uint64_t& word : words) word = generator.next();
  const auto byte = [&](std::size_t row) {
    const Normal3::Place place = Normal3::place_of(row * Normal3::kGroup + column);
    return static_cast<std::uint8_t>(words[place.step] >> place.shift);
  };
  std::array<double, 3> numbers;
  for (std::size_t k = 0; k < 3; ++k)
    numbers[k] = Normal3::from_bytes(byte(3 * k), byte(3 * k + 1), byte(3 * k + 2)) * Normal3::kUnit;
  return numbers;
}

}  // namespace cairn
