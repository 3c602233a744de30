#include "cairn/bayes/resampling/cumulative_weights.hpp"

#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/bayes/resampling/cumulative_weights.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kParts = 4;

// min((c + offset) * scale, 1)
HWY_INLINE void raise(double* c, std::size_t count, double offset, double scale) {
  const hn::ScalableTag<double> d;
  const auto raised = [&](auto tag, const double* from) HWY_ATTR {
    const auto sum = hn::Add(hn::LoadU(tag, from), hn::Set(tag, offset));
    return hn::Min(hn::Mul(sum, hn::Set(tag, scale)), hn::Set(tag, 1.0));
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) hn::StoreU(raised(d, c + i), d, c + i);
  const hn::CappedTag<double, 1> one;
  for (; i < count; ++i) hn::StoreU(raised(one, c + i), one, c + i);
}

// Cumulative sums of the weights, divided by the last one; `c` may be the weights. Each addition waits for
// the one before; hence four parts are summed side by side, and each is raised by those before it in the end.
void sum_up(const double* weights, double* c, std::size_t count) {
  const std::size_t length = count / kParts;
  double sums[kParts] = {};
  for (std::size_t i = 0; i < length; ++i) {
    HWY_UNROLL(4)
    for (std::size_t k = 0; k < kParts; ++k) c[k * length + i] = sums[k] += weights[k * length + i];
  }
  for (std::size_t i = kParts * length; i < count; ++i) c[i] = sums[kParts - 1] += weights[i];
  double total = 0.0;
  for (const double sum : sums) total += sum;
  double below = 0.0;
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t end = k + 1 < kParts ? (k + 1) * length : count;
    raise(c + k * length, end - k * length, below, 1.0 / total);
    below += sums[k];
  }
  c[count - 1] = 1.0;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(sum_up);

}  // namespace

std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights) {
  std::vector<double> cumulative;
  cumulative_weights(normalized_log_weights, cumulative);
  return cumulative;
}

void cumulative_weights(std::span<const double> normalized_log_weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!normalized_log_weights.empty());
  cumulative.resize(normalized_log_weights.size());
  exp_all(normalized_log_weights, 0.0, cumulative);
  HWY_DYNAMIC_DISPATCH(sum_up)(cumulative.data(), cumulative.data(), cumulative.size());
}

void cumulative_sums(std::span<const double> weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!weights.empty());
  cumulative.resize(weights.size());
  HWY_DYNAMIC_DISPATCH(sum_up)(weights.data(), cumulative.data(), weights.size());
}

}  // namespace cairn
#endif  // HWY_ONCE
