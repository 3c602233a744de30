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
  std::uint32_t stream = 0;       ///< that is searched with
  std::vector<Glimpse> glimpses;  ///< of the way so far, the newest last
  int new_glimpses = 0;           ///< since the last search
  std::uint32_t searches = 0;
  std::vector<LocatedPose> found;  ///< by the last search, the best first; carried on
};

/// Finds a robot that may be anywhere on the map, and says when it is found.
///
/// The first measurement chooses the first particles (GlobalStart). If the right place is not among them, or
/// dies out while another explains the next scans better, no later scan brings it back. So the map is
/// searched again and again, with all that was seen on the way, and half of the belief is drawn from what is
/// found, until both agree: the search knows one place only, after enough looks, and the belief is compact
/// and at that place. Before that no probability above `kMostUnconfirmed` is claimed.
/// Immutable; deterministic: a function of the measurements in their order.
class GlobalSearch {
 public:
  static constexpr double kMostUnconfirmed = 0.9;

  explicit GlobalSearch(const GlobalOptions& options = {}, std::uint64_t seed = 0)
      : options_(options), seed_(seed) {}

  /// The first measurement: where the robot may be. None: this sensor cannot be searched with.
  std::vector<LocatedPose> begin(GlobalSearchMemory& memory, StreamId stream, const StreamModel& model,
                                 const Event::Payload& z) const;

  /// The robot has moved.
  static void carry(GlobalSearchMemory& memory, const PoseControl& control);

  /// A further measurement. Searches if enough new was seen, and lets the filter take in what was found.
  /// @param places of the belief: they are compared with what the search finds
  /// @return true if the belief has changed
  bool observe(GlobalSearchMemory& memory, StreamId stream, const StreamModel& model, const Event::Payload& z,
               std::span<const Hypothesis> places, PoseFilter& filter) const;

  /// The belief while the robot is being looked for: half of it are the places of the particles, half those
  /// that the last search found, the heaviest first. Particles decide by every scan, and too early where the
  /// map is wrong; what the search still holds possible stays known.
  static std::vector<PoseHypothesis> with_found(const GlobalSearchMemory& memory,
                                                std::span<const PoseHypothesis> places);

  /// What is claimed of a pose that no search has confirmed yet.
  static void temper(const GlobalSearchMemory& memory, Judgement& judgement);

 private:
  bool remember(GlobalSearchMemory& memory, const Event::Payload& z) const;
  static bool confirms(const GlobalSearchMemory& memory, std::span<const Hypothesis> places,
                       const PoseFilter& filter);
  void take_in(std::span<const LocatedPose> found, std::uint32_t search, PoseFilter& filter) const;

  GlobalOptions options_;
  std::uint64_t seed_;
};

}  // namespace cairn
