#pragma once

#include "cairn/bayes/injection.hpp"
#include "cairn/bayes/models.hpp"
#include "cairn/bayes/particle_set.hpp"
#include "cairn/bayes/refinement.hpp"
#include "cairn/bayes/regularization.hpp"
#include "cairn/bayes/resampling/copy_drawn.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/bayes/sample_size.hpp"
#include "cairn/bayes/tempering.hpp"
#include "cairn/bayes/triggers/ess_ratio.hpp"
#include "cairn/bayes/weights.hpp"
#include "cairn/core/errors.hpp"
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
  /// A trigger among the parts decides instead.
  double resample_ess_ratio = 1.0;
  /// A measurement enters in portions that leave at least this effective share of the particles (see
  /// correct); 0: all at once.
  double min_ess_share = 0.0;
};

/// The exchangeable parts of a particle filter. A filter owns its parts: two filters share none.
template <class State>
struct ParticleFilterParts {
  std::unique_ptr<SampleSize<State>> size;                                  ///< must be there
  std::unique_ptr<Resampling> resampling = std::make_unique<Systematic>();  ///< must be there
  std::unique_ptr<const Trigger> resample_when = nullptr;           ///< null: EssRatio(resample_ess_ratio)
  std::unique_ptr<Regularization<State>> regularization = nullptr;  ///< null: none
  std::unique_ptr<Refinement<State>> refinement = nullptr;          ///< null: none
  std::unique_ptr<Injection<State>> injection = nullptr;            ///< null: none
};

/// All that changes in a particle filter from step to step.
template <class State>
struct ParticleFilterCheckpoint {
  ParticleSet<State> particles;
  PartMemory parts;
  std::uint64_t step = 0;
  double ess = 0.0;
  double ess_of_generation = 0.0;
  double share_entered = 1.0;
  bool compact = false;
  bool corrected = false;
  SinceLast since_resampling;
};

/// Sequential importance resampling over any state (Thrun et al., Probabilistic Robotics, table 4.3), with
/// the number of particles set by a SampleSize (KLD-sampling: Fox 2003, table 1).
///
/// Deterministic: the same initial particles, controls, measurements and seed give the same bytes for any
/// number of threads of the executor. Not itself thread-safe. On one thread it allocates only when the set
/// grows beyond its largest size, as far as its parts and models allow.
template <class State, class Control>
class ParticleFilter {
 public:
  using Parts = ParticleFilterParts<State>;
  using Checkpoint = ParticleFilterCheckpoint<State>;
  using Motion = MotionModel<State, Control>;

  ParticleFilter(std::shared_ptr<const MotionModel<State, Control>> motion, Parts parts,
                 std::shared_ptr<const Executor> executor, const ParticleFilterOptions& options)
      : motion_(std::move(motion)),
        parts_(std::move(parts)),
        executor_(std::move(executor)),
        options_(options) {
    CAIRN_ASSERT(parts_.size && parts_.resampling);
    if (!parts_.resample_when)
      parts_.resample_when = std::make_unique<const EssRatio>(options.resample_ess_ratio);
  }

  /// With systematic resampling, no refinement and no injection.
  ParticleFilter(std::shared_ptr<const MotionModel<State, Control>> motion,
                 std::unique_ptr<SampleSize<State>> size,
                 std::unique_ptr<Regularization<State>> regularization,
                 std::shared_ptr<const Executor> executor, const ParticleFilterOptions& options)
      : ParticleFilter(std::move(motion),
                       Parts{.size = std::move(size), .regularization = std::move(regularization)},
                       std::move(executor), options) {}

  /// Draws the first generation: `sample(random, i)` gives particle i. All get the same weight.
  void initialize(const std::function<State(const RandomStream&, std::uint32_t)>& sample) {
    const RandomStream random(options_.seed, RandomPurpose::kInitialize, 0);
    std::vector<State>& states = particles_.states;
    states.clear();
    for (std::size_t wanted = parts_.size->begin(); states.size() < wanted;) {
      const std::size_t first = states.size();
      while (states.size() < wanted)
        states.push_back(sample(random, static_cast<std::uint32_t>(states.size())));
      wanted = parts_.size->wanted(std::span<const State>(states).subspan(first));
    }
    set_uniform_weights();
    fit();
  }

  /// One turn of the filter: x' ~ p(x' | u, x), w = p(z | x').
  void update(const Control& u, const BoundUpdate<State>& z) {
    predict(u);
    correct(z);
  }

  /// x' ~ p(x' | u, x), after resampling if that is due. There may be any number of predictions in a row.
  void predict(const Control& u) { predict(u, *motion_); }

  /// Likewise with another motion model than usual: where the usual control is missing, for example.
  void predict(const Control& u, const Motion& motion) {
    ++step_;
    corrected_ = false;
    if (resampling_is_due()) {
      resample_and_move(u, motion);
    } else {
      move(u, motion, particles_.states, 0);
    }
    since_resampling_.add_motion(u);
  }

  /// w = p(z | x'). There may be any number of corrections in a row: measurements of the same time.
  ///
  /// Progressive correction (Oudjane & Musso, FUSION 2000): the likelihood enters in portions, each small
  /// enough to keep `min_ess_share`; between them the particles are resampled and moved a little, so that the
  /// next portion finds them where the posterior is. Without a regularization one portion enters, the rest is
  /// given up.
  void correct(const BoundUpdate<State>& z) {
    begin_correction(z);
    if (parts_.refinement) refine(z);
    double left = 1.0;
    for (std::uint32_t pass = 0;; ++pass) {
      evaluate(z);
      if (pass == 0 && parts_.injection) measure_mean_likelihood();
      left -= weigh(left);
      fit();
      if (left < kNegligibleShare || pass == kMostPasses || !compact_) break;
      resample_and_spread(pass);
    }
    share_entered_ = 1.0 - left;
    if (parts_.injection) inject(z);
  }

  /// With their weights, as logs and as they are.
  const ParticleSet<State>& particles() const { return particles_; }
  /// Effective sample size after the last measurement, 1..N.
  double ess() const { return ess_; }
  /// True if the particles are one compact group (see Regularization::fit); false without a regularization.
  bool compact() const { return compact_; }
  /// Share of the last measurement's log-likelihood that entered, 0..1 (see correct).
  double share_entered() const { return share_entered_; }

  /// Writes the state of the filter into a checkpoint; allocates only if its buffers are too small.
  void save(Checkpoint& checkpoint) const {
    checkpoint.particles = particles_;
    checkpoint.step = step_;
    checkpoint.ess = ess_;
    checkpoint.ess_of_generation = ess_of_generation_;
    checkpoint.share_entered = share_entered_;
    checkpoint.compact = compact_;
    checkpoint.corrected = corrected_;
    checkpoint.since_resampling = since_resampling_;
    checkpoint.parts.clear();
    for_each_part([&](const FilterPart& part) { part.save(checkpoint.parts); });
  }

  Checkpoint checkpoint() const {
    Checkpoint made;
    save(made);
    return made;
  }

  /// Goes back to a checkpoint of this filter, or of one made alike: the same controls and measurements then
  /// give the same bytes as they did or would have done.
  void restore(const Checkpoint& checkpoint) {
    particles_ = checkpoint.particles;
    step_ = checkpoint.step;
    ess_ = checkpoint.ess;
    ess_of_generation_ = checkpoint.ess_of_generation;
    share_entered_ = checkpoint.share_entered;
    compact_ = checkpoint.compact;
    corrected_ = checkpoint.corrected;
    since_resampling_ = checkpoint.since_resampling;
    PartMemory::Reader memory(checkpoint.parts);
    for_each_part([&](FilterPart& part) { part.load(memory); });
  }

 private:
  static constexpr std::size_t kChunk =
      128;  // particles per task; fixed, so that results do not depend on threads
  static constexpr std::size_t kSmallestBatch = 64;
  static constexpr std::uint32_t kMostPasses = 5;
  // Draws of kRegularize: 0 is for the drawings, 1 to kMostPasses for the moves after them.
  static constexpr std::uint16_t kWideMoveDraw = kMostPasses + 1;
  static constexpr std::uint32_t kInjectionDrawing = kMostPasses + 1;
  static constexpr double kNegligibleShare = 0.01;

  // Equal weights leave nothing to resample, and no measurement since the last drawing nothing new: weights
  // that it left unequal on purpose stay as they are.
  bool resampling_is_due() {
    if (since_resampling_.updates == 0) return false;
    since_resampling_.ess = ess_;
    since_resampling_.particles = static_cast<double>(particles_.size());
    return ess_ < since_resampling_.particles && parts_.resample_when->due(since_resampling_);
  }

  // Fox 2003, table 1: draw ancestors and predict them until there are as many as the predicted spread asks
  // for. Each batch is one drawing over all ancestors.
  void resample_and_move(const Control& u, const Motion& motion) {
    cumulative_sums(particles_.weights, cumulative_);
    const RandomStream random = stream(RandomPurpose::kResample);
    next_.clear();
    std::size_t wanted = parts_.size->begin();
    for (std::uint32_t batch = 0; next_.size() < wanted; ++batch) {
      const std::size_t first = next_.size();
      const std::size_t count =
          batch == 0 ? wanted
                     : std::min(std::max(wanted - first, kSmallestBatch), parts_.size->most() - first);
      draw_ancestors(count, {random, batch, static_cast<std::uint32_t>(first)});
      const std::span<State> drawn = std::span(next_).subspan(first);
      move(u, motion, drawn, first);
      if (parts_.regularization && !compact_) spread(drawn, first, kWideMoveDraw);
      wanted = parts_.size->wanted(drawn);
    }
    take_next_generation();
    since_resampling_ = {.last = since_resampling_.now, .now = since_resampling_.now};
  }

  void move(const Control& u, const Motion& motion, std::span<State> states, std::size_t first) {
    const RandomStream random = stream(RandomPurpose::kMotion);
    in_chunks(states.size(), [&](std::size_t begin, std::size_t end) {
      motion.propagate(u, states.subspan(begin, end - begin),
                       random.from_item(static_cast<std::uint32_t>(first + begin)));
    });
  }

  // A second measurement after one prediction needs random numbers of its own.
  void begin_correction(const BoundUpdate<State>& z) {
    if (corrected_) ++step_;
    corrected_ = true;
    since_resampling_.now = z.stamp;
    ++since_resampling_.updates;
  }

  void refine(const BoundUpdate<State>& z) {
    parts_.refinement->refine(z, particles_, stream(RandomPurpose::kRefine), *executor_);
    normalize_weights(particles_.log_weights, particles_.weights);
  }

  void evaluate(const BoundUpdate<State>& z) {
    log_likelihoods_.resize(particles_.size());
    in_chunks(particles_.size(), [&](std::size_t begin, std::size_t end) {
      z.log_likelihood(std::span<const State>(particles_.states).subspan(begin, end - begin),
                       std::span(log_likelihoods_).subspan(begin, end - begin));
    });
  }

  // log sum_i w_i p(z | x_i): before the weights are normalised, and independent of their number.
  void measure_mean_likelihood() {
    cumulative_.resize(particles_.size());
    for (std::size_t i = 0; i < particles_.size(); ++i)
      cumulative_[i] = particles_.log_weights[i] + log_likelihoods_[i];
    log_mean_likelihood_ = log_sum_exp(cumulative_);
  }

  // Multiplies the weights by the likelihood to the power of at most `share`; returns the power.
  double weigh(double share) {
    const double min_ess = options_.min_ess_share * ess_of_generation_;
    const double power =
        tempering_exponent(particles_.log_weights, log_likelihoods_, min_ess, share, cumulative_);
    for (std::size_t i = 0; i < particles_.size(); ++i)
      particles_.log_weights[i] += power * log_likelihoods_[i];
    ess_ = normalize_weights(particles_.log_weights, particles_.weights);
    return power;
  }

  void resample_and_spread(std::uint32_t pass) {
    resample_between(pass, particles_.size());
    spread(next_, 0, static_cast<std::uint16_t>(pass + 1));
    take_next_generation();
  }

  void inject(const BoundUpdate<State>& z) {
    const std::size_t count = particles_.size();
    const std::size_t injected = parts_.injection->wanted(z, log_mean_likelihood_, count);
    CAIRN_ASSERT(injected <= count);
    if (injected == 0) return;
    resample_between(kInjectionDrawing, count - injected);
    next_.resize(count);
    parts_.injection->sample(z, std::span(next_).subspan(count - injected), stream(RandomPurpose::kInject));
    take_next_generation();
    fit();
  }

  // A drawing within a correction: `drawing` tells them apart.
  void resample_between(std::uint32_t drawing, std::size_t count) {
    cumulative_sums(particles_.weights, cumulative_);
    next_.clear();
    const auto first = drawing * static_cast<std::uint32_t>(particles_.size());
    draw_ancestors(count, {stream(RandomPurpose::kRegularize), drawing, first});
  }

  void draw_ancestors(std::size_t count, const DrawingNumbers& numbers) {
    ancestors_.clear();
    parts_.resampling->draw(cumulative_, count, numbers, ancestors_);
    const std::size_t first = next_.size();
    next_.resize(first + count);
    copy_drawn(std::span<const State>(particles_.states), std::span<const std::uint32_t>(ancestors_),
               std::span(next_).subspan(first));
  }

  void spread(std::span<State> states, std::size_t first, std::uint16_t draw) {
    const RandomStream random = stream(RandomPurpose::kRegularize);
    parts_.regularization->move(states, random.from_item(static_cast<std::uint32_t>(first)), draw);
  }

  void fit() { compact_ = parts_.regularization && parts_.regularization->fit(particles_); }

  void take_next_generation() {
    std::swap(particles_.states, next_);
    set_uniform_weights();
    if (!parts_.resampling->weigh_drawn(particles_.log_weights)) return;
    ess_ = normalize_weights(particles_.log_weights, particles_.weights);
    ess_of_generation_ = ess_;
  }

  void set_uniform_weights() {
    const auto n = static_cast<double>(particles_.size());
    particles_.log_weights.assign(particles_.size(), -std::log(n));
    particles_.weights.assign(particles_.size(), 1.0 / n);
    ess_ = n;
    ess_of_generation_ = n;
  }

  // A reference fits into a std::function without allocating; a lambda of many captures does not.
  template <class Work>
  void in_chunks(std::size_t items, const Work& work) const {
    executor_->for_each_chunk(items, kChunk, std::cref(work));
  }

  RandomStream stream(RandomPurpose purpose) const { return {options_.seed, purpose, step_}; }

  template <class Visit>
  void for_each_part(const Visit& visit) const {
    visit(*parts_.size);
    visit(*parts_.resampling);
    if (parts_.regularization) visit(*parts_.regularization);
    if (parts_.refinement) visit(*parts_.refinement);
    if (parts_.injection) visit(*parts_.injection);
  }

  std::shared_ptr<const MotionModel<State, Control>> motion_;
  Parts parts_;
  std::shared_ptr<const Executor> executor_;
  ParticleFilterOptions options_;
  ParticleSet<State> particles_;
  std::vector<State> next_;
  std::vector<double> cumulative_;  ///< of the weights; besides, scratch
  std::vector<std::uint32_t> ancestors_;
  std::vector<double> log_likelihoods_;
  std::uint64_t step_ = 0;
  double ess_ = 0.0;
  double ess_of_generation_ = 0.0;  ///< when it was drawn: N, unless the resampling gave weights
  double share_entered_ = 1.0;
  double log_mean_likelihood_ = 0.0;  ///< of the measurement in correct()
  bool compact_ = false;
  bool corrected_ = false;  ///< since the last prediction
  SinceLast since_resampling_;
};

// Poses in a plane, moved by odometry: compiled once, in particle_filter.cpp.
extern template class ParticleFilter<Pose2, Pose2>;

}  // namespace cairn
