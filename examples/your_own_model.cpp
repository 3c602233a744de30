// The third rung: a sensor of your own in a filter of the library.
//
// Three beacons at known places tell how far away they are, with Gaussian noise, one at a time. The model
// says how likely such a range is in each state of a batch; the filter needs to know no more.
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/models/motion/differential_drive.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace {

using cairn::Point2;
using cairn::Pose2;

struct BeaconRange {
  cairn::Time stamp;
  Point2 beacon;  // metres, map frame
  double range_m = 0.0;
};

double range_to(const Point2& beacon, const Pose2& pose) {
  return std::hypot(beacon.x - pose.x, beacon.y - pose.y);
}

/// log p(z | x) = -(z - |beacon - x|)^2 / (2 sigma^2), up to a constant.
class BeaconRangeModel final : public cairn::SensorModel<Pose2, BeaconRange> {
 public:
  explicit BeaconRangeModel(double sigma_m) : sigma_m_(sigma_m) {}

  cairn::BoundUpdate<Pose2> bind(const BeaconRange& z) const override {
    return {z.stamp, [z, sigma = sigma_m_](std::span<const Pose2> states, std::span<double> out) {
              for (std::size_t i = 0; i < states.size(); ++i) {
                const double error = (z.range_m - range_to(z.beacon, states[i])) / sigma;
                out[i] = -0.5 * error * error;
              }
            }};
  }

 private:
  double sigma_m_;
};

Pose2 mean_of(const cairn::ParticleSet<Pose2>& particles) {
  Pose2 mean;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double weight = std::exp(particles.log_weights[i]);
    mean.x += weight * particles.states[i].x;
    mean.y += weight * particles.states[i].y;
  }
  return mean;
}

}  // namespace

int main() {
  constexpr double kSigma_m = 0.1;
  constexpr std::array<Point2, 3> kBeacons{{{0.0, 0.0}, {10.0, 0.0}, {5.0, 8.0}}};
  const BeaconRangeModel model(kSigma_m);
  cairn::ParticleFilter<Pose2, Pose2> filter(
      std::make_shared<const cairn::DifferentialDrive>(cairn::DifferentialDriveOptions{}),
      std::make_unique<cairn::FixedSize<Pose2>>(2000), nullptr, std::make_shared<const cairn::Executor>(),
      {});
  filter.initialize([](const cairn::RandomStream& random, std::uint32_t i) {  // anywhere in the hall
    const auto u = random.uniform4(i);
    return Pose2{10.0 * u[0], 8.0 * u[1], 6.28 * u[2] - 3.14};
  });

  Pose2 truth{2.0, 2.0, 0.5};
  const Pose2 step{0.1, 0.0, 0.02};  // what the wheels tell: 10 cm on a wide arc
  const cairn::RandomStream noise(1, cairn::RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 60; ++i) {
    truth = truth * step;
    const Point2 beacon = kBeacons[i % kBeacons.size()];
    const BeaconRange z{{}, beacon, range_to(beacon, truth) + kSigma_m * noise.normal4(i)[0]};
    filter.update(step, model.bind(z));
  }

  const Pose2 mean = mean_of(filter.particles());
  const double error_m = std::hypot(mean.x - truth.x, mean.y - truth.y);
  std::printf("estimate %.2f %.2f, truth %.2f %.2f: %.0f cm off\n", mean.x, mean.y, truth.x, truth.y,
              100.0 * error_m);
  return error_m < 0.3 ? 0 : 1;
}
