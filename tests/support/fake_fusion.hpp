#pragma once

#include "cairn/localization/fusion_localizer.hpp"
#include "small_room.hpp"

#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cairn::test {

/// A filter that only remembers what was done to it, in which order: it costs nothing and needs no map.
class FakeFilter final : public PoseFilter {
 public:
  struct State {
    Pose2 pose;
    double unknown_s = 0.0;
    std::int64_t corrections = 0;
    std::uint64_t digest = 1469598103934665603ULL;  ///< of all controls and measurements, in order
    friend bool operator==(const State&, const State&) = default;
  };

  explicit FakeFilter(State* mirror = nullptr) : mirror_(mirror) {}

  void initialize(const Sampler&) override { state_ = {}; }
  void predict(const PoseControl& control) override {
    state_.pose = state_.pose * control.T_before_after;
    state_.unknown_s += control.unknown_s;
    digest(&control.T_before_after, sizeof control.T_before_after);
    digest(&control.unknown_s, sizeof control.unknown_s);
    mirror();
  }
  void correct(const BoundUpdate<Pose2>& z) override {
    ++state_.corrections;
    digest(&z.stamp, sizeof z.stamp);
    digest(&z.stream, sizeof z.stream);
    mirror();
  }
  bool compact() const override { return true; }
  std::size_t size() const override { return 1; }
  PoseSummary summarize() const override {
    PoseSummary summary;
    summary.T_map_base = state_.pose;
    summary.ess = 1.0;
    summary.particles = 1;
    return summary;
  }
  std::vector<Pose2> sample(std::size_t at_most) const override {
    return std::vector<Pose2>(at_most > 0 ? 1 : 0, state_.pose);
  }
  std::unique_ptr<Checkpoint> new_checkpoint() const override { return std::make_unique<Saved>(); }
  void save(Checkpoint& checkpoint) const override { static_cast<Saved&>(checkpoint).state = state_; }
  void restore(const Checkpoint& checkpoint) override {
    state_ = static_cast<const Saved&>(checkpoint).state;
    mirror();
  }

 private:
  struct Saved final : Checkpoint {
    State state;
  };

  void digest(const void* data, std::size_t size) {
    unsigned char bytes[64];
    std::memcpy(bytes, data, size);
    for (std::size_t i = 0; i < size; ++i) state_.digest = (state_.digest ^ bytes[i]) * 1099511628211ULL;
  }
  void mirror() {
    if (mirror_ != nullptr) *mirror_ = state_;
  }

  State state_;
  State* mirror_;  ///< where a test looks on
};

/// A stream whose measurements say nothing but when they were made.
class FakeStream final : public StreamModel {
 public:
  explicit FakeStream(double beams = 1.0) : beams_(beams) {}
  BoundUpdate<Pose2> bind(const Event::Payload& z, bool) const override {
    BoundUpdate<Pose2> bound;
    bound.stamp = std::get<std::shared_ptr<const LaserScan>>(z)->stamp;
    return bound;
  }
  bool informs(const Event::Payload&) const override { return true; }
  double explained_share(const Event::Payload&, const Pose2&) const override { return 1.0; }
  double beams(const Event::Payload&) const override { return beams_; }

 private:
  double beams_;
};

/// Stream 0 is the odometry; there is a measuring stream after it for each of `beams` (what an update costs).
inline FusionParts fake_parts(FakeFilter::State* mirror, const std::vector<double>& beams = {1.0}) {
  FusionParts parts;
  parts.streams.names = {"odom"};
  parts.streams.odometry = StreamId{0};
  parts.streams.models.emplace_back();
  for (std::size_t i = 0; i < beams.size(); ++i) {
    parts.streams.names.push_back("sensor" + std::to_string(i + 1));
    parts.streams.models.push_back(std::make_unique<const FakeStream>(beams[i]));
  }
  const std::size_t count = parts.streams.names.size();
  parts.streams.stamp_offsets.resize(count);
  parts.streams.shares.resize(count);
  parts.streams.periods.resize(count);
  parts.filter = std::make_unique<FakeFilter>(mirror);
  parts.cost_clock = std::make_unique<ModelledCost>(1e6);  // a beam costs a millisecond
  parts.trigger.update = {0.0, 0.0};                       // everything is worth an update
  parts.executor = std::make_shared<const Executor>(1);
  return parts;
}

/// A measurement of a stream of fake_parts, that arrives `lag_s` after its stamp.
inline Event fake_measurement(double seconds, StreamId stream = 1, double lag_s = 0.0) {
  auto scan = std::make_shared<LaserScan>(LaserScan{at(seconds), 0.0, 0.1, 0.1, 10.0, {1.0f, 2.0f}});
  return {at(seconds), at(seconds + lag_s), stream, std::shared_ptr<const LaserScan>(std::move(scan))};
}

}  // namespace cairn::test
