#include "cairn/localization/cost_clock.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kMost_ns = 1e15;  // eleven days

}  // namespace

Duration ModelledCost::stop(const UpdateWork& work) {
  const double ns = ns_ * work.beams * static_cast<double>(work.particles);
  return Duration(static_cast<Duration::rep>(std::min(ns, kMost_ns)));
}

}  // namespace cairn
