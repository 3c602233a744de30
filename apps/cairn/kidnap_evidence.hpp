#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/localization/recovery.hpp"
#include "cairn/localization/stream_binding.hpp"
#include "cairn/sensing/event.hpp"

#include <optional>
#include <span>

namespace cairn::app {

/// A span of a recording whose true poses are known, and where the robot is believed at its end.
struct BelievedWay {
  Time from, to;
  Pose2 believed_at_end;
};

/// What the measurements of a span say for the true way against the believed one, as log-odds (nat): the way
/// that led to the believed pose is the true one, moved there as a whole. Measured as rivals are
/// (Rivals::evidence, RecoveryOptions::news_m), places following each scan by some decimetres. 0 and less:
/// by that measure the map explains the wrong way at least as well. nullopt: no stream has evidence for
/// places, or the reference does not reach to the end.
std::optional<double> evidence_for_truth(std::span<const Event> events, const StreamBindings& streams,
                                         const Trajectory& reference, const BelievedWay& way,
                                         const RecoveryOptions& options);

}  // namespace cairn::app
