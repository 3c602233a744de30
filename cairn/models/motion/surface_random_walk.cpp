#include "cairn/models/motion/surface_random_walk.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/surface_walk.hpp"

#include <cmath>
#include <utility>

namespace cairn {

SurfaceRandomWalk::SurfaceRandomWalk(std::shared_ptr<const TriangleMesh> mesh, double m_per_sqrt_s)
    : mesh_(std::move(mesh)), m_per_sqrt_s_(m_per_sqrt_s) {
  if (!(m_per_sqrt_s >= 0.0) || !std::isfinite(m_per_sqrt_s))
    throw ConfigurationError("m_per_sqrt_s", "is no standard deviation", "give metres per root second, >= 0");
}

void SurfaceRandomWalk::propagate(const double& seconds, std::span<SurfacePoint> states,
                                  const RandomStream& random) const {
  const double sigma_m = m_per_sqrt_s_ * std::sqrt(std::max(0.0, seconds));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto n = random.normal4(static_cast<std::uint32_t>(i));
    states[i] = walk(*mesh_, states[i], {sigma_m * n[0], sigma_m * n[1]}).point;
  }
}

}  // namespace cairn
