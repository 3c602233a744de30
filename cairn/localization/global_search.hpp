#pragma once

#include "cairn/localization/judgement.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/localization/stream_model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// All that changes while a robot that may be anywhere is being found.
struct GlobalSearchMemory {
  bool searching = false;
  std::uint32_t stream = 0;        ///< that is searched with
  std::vector<Glimpse> glimpses;   ///< of the way so far, the newest last
  int new_glimpses = 0;            ///< since the last search
  std::vector<LocatedPose> found;  ///< by the last search, the best first; carried on
  double unknown_s = 0.0;          ///< of the way without odometry
  int of_others = 0;               ///< measurements of other streams since the last of this one
};

/// Says when a robot that may be anywhere on the map is found, and where else it may be until then.
///
/// The first measurement chooses the first particles (GlobalStart). They decide by every scan, and too early
/// where the map is wrong or its corridors look alike. So the map is searched again and again, with all that
/// was seen on the way, until both agree: the search knows one place only, after enough looks, and the belief
/// is compact and at that place. Until then what is found stands beside the belief, and no probability above
/// `kMostUnconfirmed` is claimed. It does not change the belief: that is left to Recovery, whose rivals
/// compete scan by scan (decision 96). Immutable; deterministic: a function of the measurements in their
/// order.
class GlobalSearch {
 public:
  static constexpr double kMostUnconfirmed = 0.9;

  explicit GlobalSearch(const GlobalOptions& options = {}) : options_(options) {}

  /// The first measurement: where the robot may be. None: this sensor cannot be searched with.
  std::vector<LocatedPose> begin(GlobalSearchMemory& memory, StreamId stream, const StreamModel& model,
                                 const Event::Payload& z) const;

  /// The robot has moved. A second of way without odometry ends the search: what was seen before it cannot be
  /// joined with what comes after.
  static void carry(GlobalSearchMemory& memory, const PoseControl& control);

  /// A further measurement. Searches if enough new was seen. If the sensor that is searched with has fallen
  /// silent, the search begins its way anew with this one.
  /// @param places of the belief: they are compared with what the search finds
  /// @return true if what is known to be possible has changed
  bool observe(GlobalSearchMemory& memory, StreamId stream, const StreamModel& model, const Event::Payload& z,
               std::span<const Hypothesis> places, const PoseFilter& filter) const;

  /// The belief while the robot is being looked for: half of it are the places of the particles, half those
  /// that the last search found, behind them.
  static std::vector<PoseHypothesis> with_found(const GlobalSearchMemory& memory,
                                                std::span<const PoseHypothesis> places);

  /// What is claimed of a pose that no search has confirmed yet.
  static void temper(const GlobalSearchMemory& memory, Judgement& judgement);

 private:
  static bool is_of(GlobalSearchMemory& memory, StreamId stream);
  bool remember(GlobalSearchMemory& memory, const Event::Payload& z) const;
  static bool confirms(const GlobalSearchMemory& memory, std::span<const Hypothesis> places,
                       const PoseFilter& filter);

  GlobalOptions options_;
};

}  // namespace cairn
