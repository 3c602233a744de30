// Any state, 2: how far is the door open?
//
// The state is one number, measured by range beams that hit the leaf or miss it. A beam that misses says only
// that the leaf is elsewhere, so the belief is no Gaussian; the particles do not mind.
#include "examples/door_angle.hpp"

#include "cairn/bayes/particle_filter.hpp"

#include <cstdio>
#include <memory>

using door::Opening;

int main() {
  constexpr double kSigma_m = 0.03;
  const door::BeamOnDoor model(kSigma_m);
  cairn::ParticleFilter<Opening, double> filter(std::make_shared<const door::PushedDoor>(0.05),
                                                std::make_unique<cairn::FixedSize<Opening>>(1000), nullptr,
                                                std::make_shared<const cairn::Executor>(), {});
  filter.initialize([](const cairn::RandomStream& random, std::uint32_t i) {
    return Opening{door::kWidest_rad * random.uniform(i)};
  });

  const Opening truth{0.7};
  const cairn::RandomStream noise(1, cairn::RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 20; ++i) {
    door::Beam beam{{0.5, -1.5}, cairn::kPi / 2.0 + 0.02 * (static_cast<double>(i) - 10.0), 0.0};
    beam.range_m = door::expected_range_m(beam, truth) + kSigma_m * noise.normal4(i)[0];
    filter.update(0.1, model.bind(beam));
  }

  double mean = 0.0;
  const auto& particles = filter.particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    mean += std::exp(particles.log_weights[i]) * particles.states[i].rad;
  std::printf("the door stands open by %.1f degrees, truth %.1f\n", cairn::radians_to_degrees(mean),
              cairn::radians_to_degrees(truth.rad));
  return std::abs(mean - truth.rad) < 0.05 ? 0 : 1;
}
