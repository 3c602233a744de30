#include "cairn/bayes/resampling/copy_drawn.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/bayes/resampling/copy_drawn.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Three numbers each. One more is copied along, which the next pose overwrites; but none behind the last
// state.
void copy_poses(const double* HWY_RESTRICT states, std::size_t last_state, const std::uint32_t* ancestors,
                std::size_t count, double* HWY_RESTRICT out) {
  const hn::CappedTag<double, 4> d;
  const auto copy_exactly = [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) out[3 * i + k] = states[std::size_t{3} * ancestors[i] + k];
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (HWY_UNLIKELY(ancestors[i] == last_state)) {
      copy_exactly(i);
      continue;
    }
    const double* const from = states + std::size_t{3} * ancestors[i];
    for (std::size_t k = 0; k < 4; k += hn::Lanes(d)) hn::StoreU(hn::LoadU(d, from + k), d, out + 3 * i + k);
  }
  copy_exactly(count - 1);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(copy_poses);

void copy_drawn(std::span<const Pose2> states, std::span<const std::uint32_t> ancestors,
                std::span<Pose2> out) {
  CAIRN_ASSERT(out.size() == ancestors.size());
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  if (out.empty()) return;
  HWY_DYNAMIC_DISPATCH(copy_poses)
  (&states.data()->x, states.size() - 1, ancestors.data(), ancestors.size(), &out.data()->x);
}

}  // namespace cairn
#endif  // HWY_ONCE
