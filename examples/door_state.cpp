// Any state, 1: is the door open?
//
// The example of Burgard's tutorial "Recursive Bayes Filtering". The state has two values; the same
// measurements go into a discrete Bayes filter, which is exact, and into a particle filter. Nothing in either
// filter knows of doors.
#include "cairn/bayes/discrete_filter.hpp"
#include "cairn/bayes/particle_filter.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

namespace {

enum class Door { kOpen, kClosed };
enum class Action { kNothing, kClose };

/// P(closed | close, open) = 0.9.
class DoorMotion final : public cairn::MotionModel<Door, Action> {
 public:
  void propagate(const Action& u, std::span<Door> doors, const cairn::RandomStream& random) const override {
    for (std::size_t i = 0; i < doors.size(); ++i) {
      const bool succeeds = random.uniform(static_cast<std::uint32_t>(i)) < 0.9;
      if (u == Action::kClose && succeeds) doors[i] = Door::kClosed;
    }
  }
};

/// What a look at the door says: p(z | open) and p(z | closed).
struct Look {
  double if_open;
  double if_closed;
};

class DoorLook final : public cairn::SensorModel<Door, Look> {
 public:
  cairn::BoundUpdate<Door> bind(const Look& z) const override {
    return {{}, [z](std::span<const Door> doors, std::span<double> out) {
              for (std::size_t i = 0; i < doors.size(); ++i)
                out[i] = std::log(doors[i] == Door::kOpen ? z.if_open : z.if_closed);
            }};
  }
};

double p_open(const cairn::ParticleSet<Door>& particles) {
  double p = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    p += particles.states[i] == Door::kOpen ? std::exp(particles.log_weights[i]) : 0.0;
  return p;
}

bool agree(const char* when, double exact, double particles, double expected) {
  std::printf("%-28s exact %.6f   particles %.6f   tutorial %.6f\n", when, exact, particles, expected);
  return std::abs(exact - expected) < 1e-12 && std::abs(particles - expected) < 0.01;
}

}  // namespace

int main() {
  cairn::DiscreteFilter<Door> exact({Door::kOpen, Door::kClosed});
  cairn::ParticleFilter<Door, Action> sampled(std::make_shared<const DoorMotion>(),
                                              std::make_unique<cairn::FixedSize<Door>>(20'000), nullptr,
                                              std::make_shared<const cairn::Executor>(), {});
  sampled.initialize(
      [](const cairn::RandomStream&, std::uint32_t i) { return i < 10'000 ? Door::kOpen : Door::kClosed; });

  const DoorLook model;
  bool right = true;
  exact.correct(model.bind({0.6, 0.3}));
  sampled.correct(model.bind({0.6, 0.3}));
  right &= agree("after the first look: open", exact.belief()[0], p_open(sampled.particles()), 2.0 / 3.0);

  exact.correct(model.bind({0.5, 0.6}));
  sampled.correct(model.bind({0.5, 0.6}));
  right &= agree("after the second look: open", exact.belief()[0], p_open(sampled.particles()), 5.0 / 8.0);

  Eigen::MatrixXd close(2, 2);
  close << 0.1, 0.0,  // p(open | close, open), p(open | close, closed)
      0.9, 1.0;
  exact.predict(close);
  sampled.predict(Action::kClose);
  right &= agree("after closing it: open", exact.belief()[0], p_open(sampled.particles()), 1.0 / 16.0);
  return right ? 0 : 1;
}
