#pragma once

#include "cairn/localization/pose_filter.hpp"

#include <memory>
#include <span>
#include <vector>

namespace cairn::test {

/// A filter that only remembers where it was told to begin anew.
class ListeningFilter final : public PoseFilter {
 public:
  void initialize(const Sampler& sample) override {
    states_.clear();
    for (std::uint32_t i = 0; i < 300; ++i)
      states_.push_back(sample(RandomStream(1, RandomPurpose::kInitialize, 0), i));
  }
  void predict(const PoseControl&) override {}
  void correct(const BoundUpdate<Pose2>&) override {}
  bool compact() const override { return compact_; }
  std::size_t size() const override { return 1; }
  PoseSummary summarize() const override { return {}; }
  std::vector<Pose2> sample(std::size_t at_most) const override { return std::vector<Pose2>(at_most); }
  std::unique_ptr<Checkpoint> new_checkpoint() const override { return nullptr; }
  void save(Checkpoint&) const override {}
  void restore(const Checkpoint&) override {}

  bool compact_ = true;
  std::vector<Pose2> states_;
};

}  // namespace cairn::test
