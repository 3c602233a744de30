#include "cairn/bayes/gradient_refinement.hpp"

#include "cairn/bayes/kernel_density.hpp"
#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kChunk = 8;  // particles per task; fixed, so that results do not depend on threads
constexpr double kProbe_m = 0.01;

template <class Value, class Function>
void evaluate(const Function& function, const std::vector<Pose2>& states, std::vector<Value>& out,
              const Executor& executor) {
  out.resize(states.size());
  executor.for_each_chunk(states.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    function(std::span<const Pose2>(states).subspan(begin, end - begin),
             std::span(out).subspan(begin, end - begin));
  });
}

Pose2 moved(const Pose2& x, const Eigen::Vector3d& by) {
  return {x.x + by.x(), x.y + by.y(), normalize_angle(x.theta + by.z())};
}

// A gradient in coordinates in which a turn counts like a way.
Eigen::Vector3d leveled(const Eigen::Vector3d& gradient, double lever) {
  return {gradient.x(), gradient.y(), gradient.z() / lever};
}

}  // namespace

void GradientRefinementOptions::visit(OptionVisitor& v) {
  v.integer({"steps", "steps along the gradient of the observation's log-likelihood"}, steps, {0, 100});
  v.number({"eta_position", "share of the way to the maximum that a step goes, position"}, eta_position,
           {0.0, 1.0});
  v.number({"eta_heading", "likewise, heading"}, eta_heading, {0.0, 1.0});
  v.number({"max_step_m", "longest step, metres"}, max_step_m, {0.0, 10.0});
  v.number({"max_step_rad", "largest turn of a step, radians"}, max_step_rad, {0.0, 3.0});
  v.number({"lever_m", "a turn by 1 rad counts like a way of this length, metres"}, lever_m, {0.01, 1000.0});
  v.number({"kernel_width", "width of the kernels of the density estimates, in units of the rule of thumb"},
           kernel_width, {0.01, 100.0});
}

void GradientRefinement::refine(const BoundUpdate<Pose2>& z, ParticleSet<Pose2>& particles,
                                const RandomStream& random, const Executor& executor) {
  if (!z.gradient) return;
  predicted_ = particles.states;
  ascend(z, particles.states, executor);
  accept(z, predicted_, particles.states, random, executor);
  weigh(predicted_, particles);
}

// q^0 to q^r.
void GradientRefinement::ascend(const BoundUpdate<Pose2>& z, std::vector<Pose2>& states,
                                const Executor& executor) {
  const double lever = options_.lever_m;
  for (int step = 0; step < options_.steps; ++step) {
    evaluate(z.gradient, states, gradients_, executor);
    probes_ = states;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Eigen::Vector3d g = leveled(gradients_[i], lever);
      if (g.norm() > 0.0) probes_[i] = moved(states[i], leveled(kProbe_m * g.normalized(), lever));
    }
    evaluate(z.gradient, probes_, probe_gradients_, executor);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Eigen::Vector3d g = leveled(gradients_[i], lever);
      if (!(g.norm() > 0.0)) continue;
      const Eigen::Vector3d direction = g.normalized();
      const double falls = (g - leveled(probe_gradients_[i], lever)).dot(direction) / kProbe_m;
      const double way = falls > 0.0 ? g.norm() / falls : HUGE_VAL;  // to the maximum along the gradient
      const Eigen::Vector3d to_maximum = leveled(std::min(way, 1e3) * direction, lever);
      Eigen::Vector3d by(options_.eta_position * to_maximum.x(), options_.eta_position * to_maximum.y(),
                         options_.eta_heading * to_maximum.z());
      by.head<2>() *= std::min(1.0, options_.max_step_m / std::max(by.head<2>().norm(), 1e-300));
      by.z() = std::clamp(by.z(), -options_.max_step_rad, options_.max_step_rad);
      states[i] = moved(states[i], by);
    }
  }
}

// The acceptance test: from q^0 and q^r to q.
void GradientRefinement::accept(const BoundUpdate<Pose2>& z, const std::vector<Pose2>& predicted,
                                std::vector<Pose2>& states, const RandomStream& random,
                                const Executor& executor) {
  evaluate(z.log_likelihood, predicted, before_, executor);
  evaluate(z.log_likelihood, states, after_, executor);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double probability = std::exp(std::min(0.0, after_[i] - before_[i]));
    if (random.uniform(static_cast<std::uint32_t>(i)) >= probability) states[i] = predicted[i];
  }
}

// The importance densities: log p(x | u) - log q(x).
void GradientRefinement::weigh(const std::vector<Pose2>& predicted, ParticleSet<Pose2>& particles) const {
  const KernelDensity p(predicted, particles.log_weights, options_.kernel_width);
  const KernelDensity q(particles.states, particles.log_weights, options_.kernel_width);
  const std::vector<double> target = p.log_density(particles.states);
  const std::vector<double> proposal = q.log_density(particles.states);
  for (std::size_t i = 0; i < particles.size(); ++i) particles.log_weights[i] += target[i] - proposal[i];
}

}  // namespace cairn
