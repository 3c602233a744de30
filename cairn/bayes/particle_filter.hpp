#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/bayes/particle_set.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/bayes/sample_size.hpp"
#include "cairn/bayes/tempering.hpp"
#include "cairn/core/executor.hpp"
#include "cairn/core/statistics.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace cairn {

struct ParticleFilterOptions {
  std::uint64_t seed = 1;
  /// Resample when ESS / N is below this: 1 before every prediction (unless all weights are equal), 0 never.
  double resample_ess_ratio = 1.0;
  /// No measurement may leave fewer effective samples than this share of N (see tempering_exponent); 0: off.
  double min_ess_share = 0.0;
};

/// Sequential importance resampling over any state (Thrun et al., Probabilistic Robotics, table 4.3), with
/// the number of particles set by a SampleSize (KLD-sampling: Fox 2003, table 1).
///
/// Deterministic: the same initial particles, controls, measurements and seed give the same bytes for any
/// number of threads of the executor. Not itself thread-safe. Allocates only when the set grows beyond its
/// largest size.
template <class State, class Control>
class ParticleFilter {
 public:
  ParticleFilter(std::shared_ptr<const MotionModel<State, Control>> motion,
                 std::unique_ptr<SampleSize<State>> size, std::shared_ptr<const Executor> executor,
                 const ParticleFilterOptions& options)
      : motion_(std::move(motion)),
        size_(std::move(size)),
        executor_(std::move(executor)),
        options_(options) {}

  /// Draws the first generation: `sample(random, i)` gives particle i. All get the same weight.
  void initialize(const std::function<State(const RandomStream&, std::uint32_t)>& sample) {
    const RandomStream random(options_.seed, RandomPurpose::kInitialize, 0);
    std::vector<State>& states = particles_.states;
    states.clear();
    for (std::size_t wanted = size_->begin(); states.size() < wanted;) {
      const std::size_t first = states.size();
      while (states.size() < wanted)
        states.push_back(sample(random, static_cast<std::uint32_t>(states.size())));
      wanted = size_->wanted(std::span<const State>(states).subspan(first));
    }
    set_uniform_weights();
  }

  /// One turn of the filter: x' ~ p(x' | u, x), w = p(z | x').
  void update(const Control& u, const BoundUpdate<State>& z) {
    ++step_;
    if (ess_ < options_.resample_ess_ratio * static_cast<double>(particles_.size())) {
      resample_and_predict(u);
    } else {
      predict(u, particles_.states, 0);
    }
    weigh(z);
  }

  const ParticleSet<State>& particles() const { return particles_; }
  /// Effective sample size after the last measurement, 1..N.
  double ess() const { return ess_; }
  /// Exponent with which the last measurement entered (1: in full).
  double last_exponent() const { return exponent_; }

 private:
  static constexpr std::size_t kChunk =
      128;  // particles per task; fixed, so that results do not depend on threads
  static constexpr std::size_t kSmallestBatch = 64;

  // Fox 2003, table 1: draw ancestors and predict them until there are as many as the predicted spread asks
  // for. Each batch is one systematic comb over all ancestors.
  void resample_and_predict(const Control& u) {
    const std::vector<double> cumulative = cumulative_weights(particles_.log_weights);
    const RandomStream random(options_.seed, RandomPurpose::kResample, step_);
    next_.clear();
    std::size_t wanted = size_->begin();
    for (std::uint32_t batch = 0; next_.size() < wanted; ++batch) {
      const std::size_t first = next_.size();
      const std::size_t count = batch == 0 ? wanted : std::max(wanted - first, kSmallestBatch);
      ancestors_.clear();
      draw_systematic(cumulative, count, random.uniform(batch), ancestors_);
      for (const std::uint32_t ancestor : ancestors_) next_.push_back(particles_.states[ancestor]);
      const std::span<State> drawn = std::span(next_).subspan(first);
      predict(u, drawn, first);
      wanted = size_->wanted(drawn);
    }
    std::swap(particles_.states, next_);
    set_uniform_weights();
  }

  void predict(const Control& u, std::span<State> states, std::size_t first) {
    const RandomStream random(options_.seed, RandomPurpose::kMotion, step_);
    executor_->for_each_chunk(states.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      motion_->propagate(u, states.subspan(begin, end - begin),
                         random.from_item(static_cast<std::uint32_t>(first + begin)));
    });
  }

  void weigh(const BoundUpdate<State>& z) {
    log_likelihoods_.resize(particles_.size());
    executor_->for_each_chunk(particles_.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      z.log_likelihood(std::span<const State>(particles_.states).subspan(begin, end - begin),
                       std::span(log_likelihoods_).subspan(begin, end - begin));
    });
    const double min_ess = options_.min_ess_share * static_cast<double>(particles_.size());
    exponent_ = min_ess > 1.0 ? tempering_exponent(particles_.log_weights, log_likelihoods_, min_ess) : 1.0;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      particles_.log_weights[i] += exponent_ * log_likelihoods_[i];
    }
    normalize_log_weights(particles_.log_weights);
    ess_ = effective_sample_size(particles_.log_weights);
  }

  void set_uniform_weights() {
    const auto n = static_cast<double>(particles_.size());
    particles_.log_weights.assign(particles_.size(), -std::log(n));
    ess_ = n;
  }

  std::shared_ptr<const MotionModel<State, Control>> motion_;
  std::unique_ptr<SampleSize<State>> size_;
  std::shared_ptr<const Executor> executor_;
  ParticleFilterOptions options_;
  ParticleSet<State> particles_;
  std::vector<State> next_;
  std::vector<std::uint32_t> ancestors_;
  std::vector<double> log_likelihoods_;
  std::uint64_t step_ = 0;
  double ess_ = 0.0;
  double exponent_ = 1.0;
};

}  // namespace cairn
