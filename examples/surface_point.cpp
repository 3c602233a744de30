// Any state, 3: where on a surface?
//
// A crawler strays over a hull and measures how far it is from three anchors around it. The state is a point
// on a triangle mesh: it never leaves the surface, and walks over its edges.
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/maps/surface_walk.hpp"
#include "cairn/models/motion/surface_random_walk.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace {

using cairn::SurfacePoint;
using cairn::TriangleMesh;

struct AnchorRange {
  Eigen::Vector3d anchor;  // metres
  double range_m = 0.0;
};

class AnchorRangeModel final : public cairn::SensorModel<SurfacePoint, AnchorRange> {
 public:
  AnchorRangeModel(std::shared_ptr<const TriangleMesh> mesh, double sigma_m)
      : mesh_(std::move(mesh)), sigma_m_(sigma_m) {}

  cairn::BoundUpdate<SurfacePoint> bind(const AnchorRange& z) const override {
    return {{},
            [z, mesh = mesh_, sigma = sigma_m_](std::span<const SurfacePoint> states, std::span<double> out) {
              for (std::size_t i = 0; i < states.size(); ++i) {
                const double error = (z.range_m - (mesh->position(states[i]) - z.anchor).norm()) / sigma;
                out[i] = -0.5 * error * error;
              }
            }};
  }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  double sigma_m_;
};

/// A hull of 2 m by 1 m with a ridge.
TriangleMesh make_hull() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0.4, 0.5, 0.6}, {1.6, 0.5, 0.6}},
          {{0, 1, 5}, {0, 5, 4}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}},
          "hull"};
}

}  // namespace

int main() {
  constexpr double kSigma_m = 0.02, kStep_m = 0.05;
  const auto hull = std::make_shared<const TriangleMesh>(make_hull());
  const AnchorRangeModel model(hull, kSigma_m);
  const std::array<Eigen::Vector3d, 3> anchors{{{-1.0, -1.0, 0.5}, {3.0, 0.0, 1.0}, {0.5, 2.0, 1.5}}};

  cairn::ParticleFilter<SurfacePoint, double> filter(
      std::make_shared<const cairn::SurfaceRandomWalk>(hull, 0.1),
      std::make_unique<cairn::FixedSize<SurfacePoint>>(3000), nullptr,
      std::make_shared<const cairn::Executor>(), {});
  filter.initialize([&](const cairn::RandomStream& random, std::uint32_t i) {
    const auto u = random.uniform4(i);
    return hull->at_random(u[0], u[1], u[2]);  // anywhere on the hull
  });

  cairn::WalkEnd truth{{0, {0.3, 0.3, 0.4}}, {0.8 * kStep_m, 0.6 * kStep_m}};
  const cairn::RandomStream noise(1, cairn::RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 60; ++i) {  // straight ahead, over the ridge and down
    truth = walk(*hull, truth.point, truth.step);
    const Eigen::Vector3d& anchor = anchors[i % anchors.size()];
    const double range_m = (hull->position(truth.point) - anchor).norm() + kSigma_m * noise.normal4(i)[0];
    filter.update(0.5, model.bind({anchor, range_m}));
  }

  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto& particles = filter.particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    mean += std::exp(particles.log_weights[i]) * hull->position(particles.states[i]);
  const double error_m = (mean - hull->position(truth.point)).norm();
  std::printf("the crawler is at %.2f %.2f %.2f, %.0f mm off\n", mean.x(), mean.y(), mean.z(),
              1000.0 * error_m);
  return error_m < 0.1 ? 0 : 1;
}
