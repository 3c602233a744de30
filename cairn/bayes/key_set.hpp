#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cairn {

/// A set of 64-bit keys for counting again and again: clearing it keeps its memory. Open addressing with
/// linear probing, at most half full.
class KeySet {
 public:
  void clear() {
    // Slots of earlier rounds count as free, so that clearing does not touch them.
    if (++round_ == 0) {
      slots_.assign(slots_.size(), {});
      round_ = 1;
    }
    size_ = 0;
  }

  void insert(std::uint64_t key) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = find(key);
    if (slot.round == round_) return;
    slot = {key, round_};
    ++size_;
  }

  std::size_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t round = 0;
  };

  // The key's slot, or the free one where it belongs. @pre there is a free one
  Slot& find(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash(key) & mask;
    while (slots_[i].round == round_ && slots_[i].key != key) i = (i + 1) & mask;
    return slots_[i];
  }

  void grow() {
    const std::vector<Slot> before = std::move(slots_);
    slots_.assign(before.empty() ? 64 : 2 * before.size(), {});
    for (const Slot& slot : before) {
      if (slot.round == round_) find(slot.key) = slot;
    }
  }

  // Finalizer of SplitMix64 (Steele, Lea & Flood 2014).
  static std::uint64_t hash(std::uint64_t key) {
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9U;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebU;
    return key ^ (key >> 31);
  }

  std::vector<Slot> slots_;  ///< a power of two
  std::size_t size_ = 0;
  std::uint32_t round_ = 1;
};

}  // namespace cairn
