#include "cairn/core/diagnostics.hpp"

namespace cairn {

void Diagnostics::warn(const std::string& kind, const std::string& where, const std::string& what) {
  if (++counts_[kind] <= kExamplesPerKind) examples_.push_back({kind, where + ": " + what});
}

}  // namespace cairn
