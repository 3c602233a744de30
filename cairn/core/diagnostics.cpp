#include "cairn/core/diagnostics.hpp"

#include <algorithm>
#include <limits>

namespace cairn {

void Diagnostics::warn(const std::string& kind, const std::string& where, const std::string& what) {
  if (++counts_[kind] <= kExamplesPerKind) examples_.push_back({kind, where + ": " + what});
}

void Diagnostics::count(const std::string& kind, std::uint64_t n) {
  std::int64_t& so_far = counts_[kind];
  const auto room = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() - so_far);
  so_far += static_cast<std::int64_t>(std::min(n, room));
}

void Diagnostics::add(const Diagnostics& other) {
  for (const auto& [kind, n] : other.counts_) count(kind, static_cast<std::uint64_t>(n));
  examples_.insert(examples_.end(), other.examples_.begin(), other.examples_.end());
}

}  // namespace cairn
