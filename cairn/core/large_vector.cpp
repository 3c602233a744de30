#include "cairn/core/large_vector.hpp"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace cairn {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

}  // namespace

void* allocate_array(std::size_t bytes) {
  if (bytes < kLargeBytes) return ::operator new(bytes);
  const std::size_t whole_pages = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  void* const memory = std::aligned_alloc(kLargePage, whole_pages);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // A wish: where it is refused, small pages do as well.
  static_cast<void>(madvise(memory, whole_pages, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_array(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLargeBytes) {
    ::operator delete(memory);
  } else {
    std::free(memory);
  }
}

}  // namespace cairn
