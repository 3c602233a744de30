#pragma once

#include "cairn/localization/pose_filter.hpp"

#include <memory>
#include <span>
#include <vector>

namespace cairn::test {

/// A filter that only remembers what it was told to take in.
class ListeningFilter final : public PoseFilter {
 public:
  void initialize(const Sampler&) override {}
  void predict(const PoseControl&) override {}
  void correct(const BoundUpdate<Pose2>&) override {}
  void take_in(std::span<const Pose2> states, std::span<const double> weights, double share) override {
    states_.assign(states.begin(), states.end());
    weights_.assign(weights.begin(), weights.end());
    share_ = share;
  }
  bool compact() const override { return compact_; }
  std::size_t size() const override { return 1; }
  PoseSummary summarize() const override { return {}; }
  std::vector<Pose2> sample(std::size_t at_most) const override { return std::vector<Pose2>(at_most); }
  std::unique_ptr<Checkpoint> new_checkpoint() const override { return nullptr; }
  void save(Checkpoint&) const override {}
  void restore(const Checkpoint&) override {}

  bool compact_ = true;
  std::vector<Pose2> states_;
  std::vector<double> weights_;
  double share_ = 0.0;
};

}  // namespace cairn::test
