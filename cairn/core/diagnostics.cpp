#include "cairn/core/diagnostics.hpp"

namespace cairn {

void Diagnostics::warn(const std::string& kind, const std::string& where, const std::string& what) {
  if (++counts_[kind] <= kExamplesPerKind) examples_.push_back({kind, where + ": " + what});
}

void Diagnostics::add(const Diagnostics& other) {
  for (const auto& [kind, count] : other.counts_) counts_[kind] += count;
  examples_.insert(examples_.end(), other.examples_.begin(), other.examples_.end());
}

}  // namespace cairn
