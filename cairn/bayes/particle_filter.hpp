#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/bayes/particle_set.hpp"
#include "cairn/bayes/regularization.hpp"
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
  /// A measurement enters in portions that leave at least this effective share of the particles (see
  /// correct); 0: all at once.
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
                 std::unique_ptr<SampleSize<State>> size,
                 std::unique_ptr<Regularization<State>> regularization,
                 std::shared_ptr<const Executor> executor, const ParticleFilterOptions& options)
      : motion_(std::move(motion)),
        size_(std::move(size)),
        regularization_(std::move(regularization)),
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
    compact_ = regularization_ && regularization_->fit(particles_);
  }

  /// One turn of the filter: x' ~ p(x' | u, x), w = p(z | x').
  void update(const Control& u, const BoundUpdate<State>& z) {
    ++step_;
    if (ess_ < options_.resample_ess_ratio * static_cast<double>(particles_.size())) {
      resample_and_predict(u);
    } else {
      predict(u, particles_.states, 0);
    }
    correct(z);
  }

  const ParticleSet<State>& particles() const { return particles_; }
  /// Effective sample size after the last measurement, 1..N.
  double ess() const { return ess_; }
  /// True if the particles are one compact group (see Regularization::fit); false without a regularization.
  bool compact() const { return compact_; }
  /// Share of the last measurement's log-likelihood that entered, 0..1 (see correct).
  double share_entered() const { return share_entered_; }

 private:
  static constexpr std::size_t kChunk =
      128;  // particles per task; fixed, so that results do not depend on threads
  static constexpr std::size_t kSmallestBatch = 64;
  static constexpr std::uint32_t kMostPasses = 5;
  // Draws of kRegularize: 0 are the offsets of the combs, 1 to kMostPasses the moves after them.
  static constexpr std::uint16_t kWideMoveDraw = kMostPasses + 1;
  static constexpr double kNegligibleShare = 0.01;

  // Fox 2003, table 1: draw ancestors and predict them until there are as many as the predicted spread asks
  // for. Each batch is one systematic comb over all ancestors.
  void resample_and_predict(const Control& u) {
    const std::vector<double> cumulative = cumulative_weights(particles_.log_weights);
    const RandomStream random(options_.seed, RandomPurpose::kResample, step_);
    const RandomStream moves(options_.seed, RandomPurpose::kRegularize, step_);
    next_.clear();
    std::size_t wanted = size_->begin();
    for (std::uint32_t batch = 0; next_.size() < wanted; ++batch) {
      const std::size_t first = next_.size();
      const std::size_t count =
          batch == 0 ? wanted : std::min(std::max(wanted - first, kSmallestBatch), size_->most() - first);
      ancestors_.clear();
      draw_systematic(cumulative, count, random.uniform(batch), ancestors_);
      for (const std::uint32_t ancestor : ancestors_) next_.push_back(particles_.states[ancestor]);
      const std::span<State> drawn = std::span(next_).subspan(first);
      predict(u, drawn, first);
      if (regularization_ && !compact_)
        regularization_->move(drawn, moves.from_item(static_cast<std::uint32_t>(first)), kWideMoveDraw);
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

  // Progressive correction (Oudjane & Musso, FUSION 2000): the likelihood enters in portions, each small
  // enough to keep `min_ess_share`; between them the particles are resampled and moved a little, so that the
  // next portion finds them where the posterior is. Without a regularization one portion enters, the rest is
  // given up.
  void correct(const BoundUpdate<State>& z) {
    double left = 1.0;
    for (std::uint32_t pass = 0;; ++pass) {
      left -= weigh(z, left);
      compact_ = regularization_ && regularization_->fit(particles_);
      if (left < kNegligibleShare || pass == kMostPasses || !compact_) break;
      resample_and_move(pass);
    }
    share_entered_ = 1.0 - left;
  }

  // Multiplies the weights by the likelihood to the power of at most `share`; returns the power.
  double weigh(const BoundUpdate<State>& z, double share) {
    log_likelihoods_.resize(particles_.size());
    executor_->for_each_chunk(particles_.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      z.log_likelihood(std::span<const State>(particles_.states).subspan(begin, end - begin),
                       std::span(log_likelihoods_).subspan(begin, end - begin));
    });
    const double min_ess = options_.min_ess_share * static_cast<double>(particles_.size());
    const double power = tempering_exponent(particles_.log_weights, log_likelihoods_, min_ess, share);
    for (std::size_t i = 0; i < particles_.size(); ++i)
      particles_.log_weights[i] += power * log_likelihoods_[i];
    normalize_log_weights(particles_.log_weights);
    ess_ = effective_sample_size(particles_.log_weights);
    return power;
  }

  void resample_and_move(std::uint32_t pass) {
    const RandomStream random(options_.seed, RandomPurpose::kRegularize, step_);
    ancestors_.clear();
    draw_systematic(cumulative_weights(particles_.log_weights), particles_.size(), random.uniform(pass),
                    ancestors_);
    next_.clear();
    for (const std::uint32_t ancestor : ancestors_) next_.push_back(particles_.states[ancestor]);
    regularization_->move(next_, random, static_cast<std::uint16_t>(pass + 1));
    std::swap(particles_.states, next_);
    set_uniform_weights();
  }

  void set_uniform_weights() {
    const auto n = static_cast<double>(particles_.size());
    particles_.log_weights.assign(particles_.size(), -std::log(n));
    ess_ = n;
  }

  std::shared_ptr<const MotionModel<State, Control>> motion_;
  std::unique_ptr<SampleSize<State>> size_;
  std::unique_ptr<Regularization<State>> regularization_;
  std::shared_ptr<const Executor> executor_;
  ParticleFilterOptions options_;
  ParticleSet<State> particles_;
  std::vector<State> next_;
  std::vector<std::uint32_t> ancestors_;
  std::vector<double> log_likelihoods_;
  std::uint64_t step_ = 0;
  double ess_ = 0.0;
  double share_entered_ = 1.0;
  bool compact_ = false;
};

}  // namespace cairn
