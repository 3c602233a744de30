// The second rung: the library without a file. A localizer takes events one by one and has an estimate after
// each.
#include "cairn/core/angle.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "cairn/sim/office_recording.hpp"

#include <cstdio>
#include <memory>

int main() {
  // A minute of a robot's drive through an office; on a robot, the events come from its drivers.
  cairn::OfficeRecordingOptions drive;
  drive.duration = cairn::duration_from_seconds(60.0);
  const cairn::OfficeRecording recording = cairn::record_office(drive, 1);

  const cairn::LocalizerOptions options;  // the defaults; see localizer_options.hpp
  const cairn::Start start{recording.truth.front().pose};
  cairn::MonteCarloLocalizer localizer(options, recording.streams, recording.map, start, /*seed=*/1,
                                       std::make_shared<const cairn::Executor>());
  for (const cairn::Event& event : recording.events) localizer.process(event);
  localizer.finish();

  const cairn::Estimate estimate = localizer.estimate().value();
  const cairn::Pose2 truth = cairn::pose_at(recording.truth, estimate.stamp).value();
  const double error_m = cairn::distance(estimate.T_map_base, truth);
  std::printf("after %.1f s: x %.3f m, y %.3f m, heading %.1f degrees; %.1f cm off the truth\n",
              cairn::to_seconds(estimate.stamp), estimate.T_map_base.x, estimate.T_map_base.y,
              cairn::radians_to_degrees(estimate.T_map_base.theta), 100.0 * error_m);
  return error_m < 0.2 ? 0 : 1;
}
