#pragma once

#include "cairn/core/errors.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "small_room.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cairn::test {

inline const Pose2 kStart{2.0, 1.5, 0.0};

inline LocalizerOptions few_particles() {
  LocalizerOptions options;
  options.recipe = "mcl";
  options.filter.particles = 300;
  return options;
}

class MonteCarloLocalizerTest : public ::testing::Test {
 protected:
  void make(const LocalizerOptions& options = few_particles(), const Start& start = {kStart}, int threads = 1,
            std::uint64_t seed = 1) {
    estimates_.clear();
    localizer_ = std::make_unique<MonteCarloLocalizer>(options, streams_, map_, start, seed,
                                                       std::make_shared<const Executor>(threads));
    localizer_->set_observer([this](const Estimate& e) { estimates_.push_back(e); });
  }

  std::string refusal(const LocalizerOptions& options, const Start& start = {kStart}) {
    try {
      make(options, start);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  }

  Outcome odometry(double seconds) {
    return localizer_->process(odometry_event(seconds, on_circle({}, seconds)));
  }
  Outcome scan(double seconds) {
    return localizer_->process(scan_event(scan_from(map_, on_circle(kStart, seconds), at(seconds))));
  }
  std::int64_t count(Outcome outcome, StreamId stream = 1) const {
    return localizer_->outcomes()[stream][static_cast<std::size_t>(outcome)];
  }
  std::int64_t warnings(const std::string& kind) const {
    const auto& counts = localizer_->diagnostics().counts();
    return counts.contains(kind) ? counts.at(kind) : 0;
  }
  // A scan of an open place: nothing within reach.
  Outcome open_scan(double seconds) {
    LaserScan open = scan_from(map_, on_circle(kStart, seconds), at(seconds));
    std::fill(open.ranges_m.begin(), open.ranges_m.end(), std::numeric_limits<float>::infinity());
    return localizer_->process(scan_event(std::move(open)));
  }
  // Odometry at 20 Hz and a scan every 0.2 s between them, from 0 to `seconds`.
  void drive(double seconds) {
    const int steps = static_cast<int>(20 * seconds);
    for (int i = 0; i <= steps; ++i) {
      odometry(0.05 * i);
      if (i % 4 == 0 && i < steps) scan(0.05 * i + 0.013);
    }
    localizer_->finish();
  }

  OccupancyGrid map_ = small_room();
  std::vector<StreamInfo> streams_ = odometry_and_laser();
  std::unique_ptr<MonteCarloLocalizer> localizer_;
  std::vector<Estimate> estimates_;
};

}  // namespace cairn::test
