#pragma once

#include "cairn/core/time.hpp"

#include <chrono>
#include <cstdint>

namespace cairn {

/// What an update had to do.
struct UpdateWork {
  double beams = 0.0;          ///< evaluated parts of the measurement, in units of the cost of one
  std::int64_t particles = 0;  ///< states that each of them was evaluated in
};

/// Tells what updates cost, for the scheduler. Injected, so that a localizer reads no clock by itself: with a
/// model of the cost, runs under a scheduler replay bit by bit, too.
class CostClock {
 public:
  virtual ~CostClock() = default;
  virtual void start() = 0;
  /// Cost of what was done since start().
  virtual Duration stop(const UpdateWork& work) = 0;
};

/// cost = beams * particles * ns: the same in every replay.
class ModelledCost final : public CostClock {
 public:
  explicit ModelledCost(double ns_per_beam_and_particle) : ns_(ns_per_beam_and_particle) {}
  void start() override {}
  Duration stop(const UpdateWork& work) override;

 private:
  double ns_;
};

/// The time that really passed: for a robot that runs.
class WallClockCost final : public CostClock {
 public:
  void start() override { started_ = std::chrono::steady_clock::now(); }
  Duration stop(const UpdateWork&) override { return std::chrono::steady_clock::now() - started_; }

 private:
  std::chrono::steady_clock::time_point started_;
};

}  // namespace cairn
