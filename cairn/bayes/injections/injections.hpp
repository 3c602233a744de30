#pragma once

#include "cairn/bayes/injection.hpp"
#include "cairn/bayes/injections/sample_from.hpp"
#include "cairn/bayes/resampling/two_stage.hpp"

#include <memory>
#include <utility>

namespace cairn {

/// The likelihood of a scan, brought to one beam: the geometric mean over its `effective_beams` independent
/// ones of the particles' mean likelihood *before* it is normalised. It is the same for any number of
/// particles and of beams: 1 for a scan that fits as well as the model allows, z_rand for one that fits
/// nowhere. (Averages of normalised weights are 1 / N whatever the robot sees.)
double likelihood_per_beam(double log_mean_likelihood, double effective_beams);

struct SensorResettingOptions {
  double threshold = 0.4;  ///< P_t: particles are replaced while the likelihood per beam is below this
  void visit(OptionVisitor& visitor);
};

/// Sensor resetting (Lenser & Veloso, ICRA 2000; Sehestedt & Schneider 2006, eq. 1):
///   N_s = (1 - P / P_t) N, clamped to [0, N],
/// with P the likelihood per beam. (The paper prints P as the sum of normalised weights over N, which says
/// nothing of the measurement: it must be taken before they are normalised.)
template <class State>
class SensorResetting final : public Injection<State> {
 public:
  SensorResetting(const SensorResettingOptions& options, double effective_beams,
                  std::shared_ptr<const SampleFrom<State>> source)
      : options_(options), effective_beams_(effective_beams), source_(std::move(source)) {}

  std::size_t wanted(const BoundUpdate<State>&, double log_mean_likelihood, std::size_t particles) override {
    const double share =
        1.0 - likelihood_per_beam(log_mean_likelihood, effective_beams_) / options_.threshold;
    return static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(particles));
  }
  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    source_->sample(z, states, random);
  }

 private:
  SensorResettingOptions options_;
  double effective_beams_;
  std::shared_ptr<const SampleFrom<State>> source_;
};

struct AugmentedOptions {
  double alpha_slow = 0.002;  ///< share of a new measurement in the long-term average
  double alpha_fast = 0.2;    ///< likewise in the short-term one
  void visit(OptionVisitor& visitor);
  /// @throws ConfigurationError unless 0 <= alpha_slow < alpha_fast
  void validate() const;
};

/// Augmented MCL (Thrun et al., Probabilistic Robotics, table 8.3): averages of the measurements' likelihood
/// over a long and a short time; while things are worse than usual, max(0, 1 - w_fast / w_slow) of the
/// particles are replaced. The averages begin at the first likelihood, not at zero.
template <class State>
class Augmented final : public Injection<State> {
 public:
  Augmented(const AugmentedOptions& options, double effective_beams,
            std::shared_ptr<const SampleFrom<State>> source)
      : options_(options), effective_beams_(effective_beams), source_(std::move(source)) {}

  std::size_t wanted(const BoundUpdate<State>&, double log_mean_likelihood, std::size_t particles) override {
    const double now = likelihood_per_beam(log_mean_likelihood, effective_beams_);
    slow_ = slow_ < 0.0 ? now : slow_ + options_.alpha_slow * (now - slow_);
    fast_ = fast_ < 0.0 ? now : fast_ + options_.alpha_fast * (now - fast_);
    if (!(slow_ > 0.0)) return 0;
    return static_cast<std::size_t>(std::clamp(1.0 - fast_ / slow_, 0.0, 1.0) *
                                    static_cast<double>(particles));
  }
  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    source_->sample(z, states, random);
  }
  void save(PartMemory& memory) const override { memory.put(slow_), memory.put(fast_); }
  void load(PartMemory::Reader& memory) override { slow_ = memory.take(), fast_ = memory.take(); }

 private:
  AugmentedOptions options_;
  double effective_beams_;
  std::shared_ptr<const SampleFrom<State>> source_;
  double slow_ = -1.0;  ///< none yet
  double fast_ = -1.0;
};

/// KLD-sampling with sensor resetting (Sehestedt & Schneider, table 2, step 2): the particles by which the
/// set has grown since the last measurement are samples of p(x | z) rather than copies.
template <class State>
class NewFromMeasurement final : public Injection<State> {
 public:
  explicit NewFromMeasurement(std::shared_ptr<const SampleFrom<State>> source) : source_(std::move(source)) {}

  std::size_t wanted(const BoundUpdate<State>&, double, std::size_t particles) override {
    const std::size_t before = before_ == 0 ? particles : before_;
    before_ = particles;
    return particles > before ? particles - before : 0;
  }
  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    source_->sample(z, states, random);
  }
  void save(PartMemory& memory) const override { memory.put(static_cast<double>(before_)); }
  void load(PartMemory::Reader& memory) override { before_ = static_cast<std::size_t>(memory.take()); }

 private:
  std::shared_ptr<const SampleFrom<State>> source_;
  std::size_t before_ = 0;
};

/// Clustered sensor resetting (Sehestedt & Schneider, table 3, step 6): replaces no particle while there are
/// several significant clusters, for that could lose one of them.
template <class State>
class OnlyWithOneCluster final : public Injection<State> {
 public:
  OnlyWithOneCluster(std::shared_ptr<const ClusterTable> table, std::unique_ptr<Injection<State>> rule)
      : table_(std::move(table)), rule_(std::move(rule)) {}

  std::size_t wanted(const BoundUpdate<State>& z, double log_mean_likelihood,
                     std::size_t particles) override {
    const std::size_t wanted = rule_->wanted(z, log_mean_likelihood, particles);
    return table_->clusters > 1 ? 0 : wanted;
  }
  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    rule_->sample(z, states, random);
  }
  void save(PartMemory& memory) const override { rule_->save(memory); }
  void load(PartMemory::Reader& memory) override { rule_->load(memory); }

 private:
  std::shared_ptr<const ClusterTable> table_;
  std::unique_ptr<Injection<State>> rule_;
};

}  // namespace cairn
