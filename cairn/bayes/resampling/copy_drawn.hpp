#pragma once

#include "cairn/core/errors.hpp"
#include "cairn/core/pose2.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn {

/// out[i] = states[ancestors[i]]. @pre equal sizes of `ancestors` and `out`, all ancestors among the states;
/// `out` does not overlap them
template <class State>
void copy_drawn(std::span<const State> states, std::span<const std::uint32_t> ancestors,
                std::span<State> out) {
  CAIRN_ASSERT(out.size() == ancestors.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = states[ancestors[i]];
}

/// The same for poses, a vector at a time (see simd.hpp).
void copy_drawn(std::span<const Pose2> states, std::span<const std::uint32_t> ancestors,
                std::span<Pose2> out);

}  // namespace cairn
