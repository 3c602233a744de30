#pragma once

#include "cairn/bayes/filter_part.hpp"
#include "cairn/bayes/kld.hpp"
#include "cairn/bayes/occupied_bins.hpp"
#include "cairn/core/pose2.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace cairn {

/// How many particles the next generation has: asked again and again while it is drawn.
template <class State>
class SampleSize : public FilterPart {
 public:
  /// Starts a generation and returns the number of particles to draw first.
  virtual std::size_t begin() = 0;

  /// Takes notice of newly drawn, already predicted particles; returns how many there should be in all.
  virtual std::size_t wanted(std::span<const State> newly_drawn) = 0;

  /// A generation never has more particles than this.
  virtual std::size_t most() const = 0;
};

/// Always the same number.
template <class State>
class FixedSize final : public SampleSize<State> {
 public:
  explicit FixedSize(std::size_t count) : count_(count) {}
  std::size_t begin() override { return count_; }
  std::size_t wanted(std::span<const State>) override { return count_; }
  std::size_t most() const override { return count_; }

 private:
  std::size_t count_;
};

/// KLD-sampling (Fox 2003, table 1): as many as the bins that the *predicted* particles occupy ask for.
/// Counting after the prediction and before the measurement is what lets the set grow when the robot's motion
/// has spread the belief, instead of one step too late.
class KldSize final : public SampleSize<Pose2> {
 public:
  KldSize(const KldOptions& options, std::size_t min_particles, std::size_t max_particles)
      : bound_(options), min_(min_particles), max_(max_particles), occupied_(options) {}

  std::size_t begin() override {
    occupied_.clear();
    return min_;
  }

  std::size_t wanted(std::span<const Pose2> newly_drawn) override {
    occupied_.insert(newly_drawn);
    return std::clamp(bound_(occupied_.size()), min_, max_);
  }

  std::size_t most() const override { return max_; }

 private:
  KldBound bound_;
  std::size_t min_;
  std::size_t max_;
  OccupiedBins occupied_;
};

}  // namespace cairn
