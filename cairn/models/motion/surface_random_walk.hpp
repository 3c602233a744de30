#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/maps/triangle_mesh.hpp"

#include <memory>

namespace cairn {

/// A point that strays over a surface: a contact between a hand and a body, say, of which nothing else is
/// known. The control is the time that passes, in seconds. Each particle walks straight ahead
/// (surface_walk.hpp) by a normally distributed step; over a closed mesh the walk leaves a uniform belief
/// uniform.
class SurfaceRandomWalk final : public MotionModel<SurfacePoint, double> {
 public:
  /// @param m_per_sqrt_s standard deviation of the step along either axis after one second
  /// @throws ConfigurationError if it is negative or not finite
  SurfaceRandomWalk(std::shared_ptr<const TriangleMesh> mesh, double m_per_sqrt_s);

  void propagate(const double& seconds, std::span<SurfacePoint> states,
                 const RandomStream& random) const override;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  double m_per_sqrt_s_;
};

}  // namespace cairn
