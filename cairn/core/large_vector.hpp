#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace cairn {

/// Memory for arrays. From kLargeBytes on it begins on a page of 2 MiB and the system is asked for such
/// pages, where it has them (Linux, transparent_hugepage `madvise` or `always`): the first touch of fresh
/// memory by pages of 4 KiB takes longer than filling a distance field.
inline constexpr std::size_t kLargeBytes = std::size_t{8} << 20;

/// @throws std::bad_alloc
void* allocate_array(std::size_t bytes);
void free_array(void* memory, std::size_t bytes) noexcept;

/// Leaves elements uninitialised that are made without a value, as in `LargeVector<int> v(n)`.
template <class T>
struct LargeAllocator {
  static_assert(std::is_trivial_v<T>);
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>& /*other*/) noexcept {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / (2 * sizeof(T))) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_array(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept { free_array(memory, n * sizeof(T)); }

  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0) {
      ::new (static_cast<void*>(place)) U;
    } else {
      ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
  }

  bool operator==(const LargeAllocator& /*other*/) const { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace cairn
