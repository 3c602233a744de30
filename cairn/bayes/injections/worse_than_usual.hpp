#pragma once

#include "cairn/bayes/injections/injections.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace cairn {

/// Applies a rule only while measurements fit worse than usual: while w_fast < share * w_slow, the short- and
/// the long-term average of the likelihood (Gutmann & Fox, IROS 2002, inject max(0, 1 - nu w_fast / w_slow);
/// share is 1 / nu). Samples of p(x | z) are dear, and where nothing is wrong they are wrong.
///
/// The likelihood of a measurement is that of one beam, between 1 and `least`, by where its logarithm lies
/// between 0 and that of a state which explains nothing. So it is the same for any number of beams, and a
/// measurement that counts as few wide beams, while the belief is spread over several places, is neither
/// better nor worse than one that counts as many sharp ones.
template <class State>
class WhileWorseThanUsual final : public Injection<State> {
 public:
  struct Usual {
    double share = 0.5;
    AugmentedOptions averages;
    State nowhere;        ///< explains nothing
    double least = 0.15;  ///< likelihood of a beam there
  };

  WhileWorseThanUsual(const Usual& usual, std::unique_ptr<Injection<State>> rule)
      : usual_(usual), rule_(std::move(rule)) {}

  std::size_t wanted(const BoundUpdate<State>& z, double log_mean_likelihood,
                     std::size_t particles) override {
    const double now = likelihood(z, log_mean_likelihood);
    slow_ = slow_ < 0.0 ? now : slow_ + usual_.averages.alpha_slow * (now - slow_);
    fast_ = fast_ < 0.0 ? now : fast_ + usual_.averages.alpha_fast * (now - fast_);
    const std::size_t wanted = rule_->wanted(z, log_mean_likelihood, particles);
    return fast_ < usual_.share * slow_ ? wanted : 0;
  }
  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    rule_->sample(z, states, random);
  }
  void save(PartMemory& memory) const override {
    memory.put(slow_), memory.put(fast_);
    rule_->save(memory);
  }
  void load(PartMemory::Reader& memory) override {
    slow_ = memory.take(), fast_ = memory.take();
    rule_->load(memory);
  }

 private:
  double likelihood(const BoundUpdate<State>& z, double log_mean_likelihood) const {
    double nothing = 0.0;
    z.log_likelihood({&usual_.nowhere, 1}, {&nothing, 1});
    if (!(nothing < 0.0)) return 1.0;  // it tells no state from another
    return std::pow(usual_.least, std::clamp(log_mean_likelihood / nothing, 0.0, 1.0));
  }

  Usual usual_;
  std::unique_ptr<Injection<State>> rule_;
  double slow_ = -1.0;  ///< none yet
  double fast_ = -1.0;
};

}  // namespace cairn
