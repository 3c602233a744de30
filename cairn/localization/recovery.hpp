#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/time.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/localization/stream_model.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// When and how a lost robot is looked for.
struct RecoveryOptions {
  bool active = false;            ///< off: see decision 90
  double doubt = 0.5;             ///< a search begins when the pose is right with less than this probability
  double every_s = 0.5;           ///< time between two searches, doubled after each that finds nothing better
  double at_most_every_s = 2.0;   ///< up to this
  int scans = 8;                  ///< of the last ones that may be joined
  double spacing_m = 0.2;         ///< those nearer to the one before than this ...
  double spacing_rad = 0.2;       ///< ... and turned by less than this are left out, but for the newest
  int most_poses = 10;            ///< distinct places
  double sigma_hit_m = 0.15;      ///< as laser.sigma_hit_m, in the search
  double effective_beams = 20.0;  ///< as laser.effective_beams, for the first of the joined scans
  double further_beams = 10.0;    ///< likewise for each of the others
  double millions_of_points = 30.0;  ///< a search looks up at most this many million end points
  int particles = 300;               ///< that come in
  double least_share = 0.02;         ///< candidates that deserve less of the belief do not come in

  void visit(OptionVisitor& visitor);
};

/// All that changes in a recovery.
struct RecoveryMemory {
  std::vector<Glimpse> glimpses;  ///< since the pose came into doubt, the newest last
  std::uint32_t stream = 0;       ///< that they are of
  bool searched = false;
  Time searched_at;
  double wait_s = 0.0;
  std::uint32_t searches = 0;
};

/// Brings a robot that was carried away back: global localization from the scans since its pose came into
/// doubt. What the search finds competes with what is believed, by its evidence:
///
///   share = l E / (l E + (1 - l) B),   E = 1/V sum_c integral p(z | x) dx,   B = mean of p(z | x) over the
///   belief
///
/// with l the probability of being lost, z the joined scans, and c the places found. A robot among people is
/// not lost, so that no search begins; a belief that explains the scans as well as anything else outweighs
/// what was found elsewhere by its B, for E pays for all the poses that would have been possible.
/// Immutable; deterministic: a function of the measurements in their order.
class Recovery {
 public:
  Recovery(const RecoveryOptions& options, std::uint64_t seed) : options_(options), seed_(seed) {}

  /// The robot has moved.
  static void carry(RecoveryMemory& memory, const Pose2& T_before_after);
  /// Remembers a measurement. @param in_doubt whether it or the ones before speak against the pose
  void observe(RecoveryMemory& memory, StreamId stream, const Event::Payload& z, bool in_doubt) const;

  /// Searches, if it is time to, and lets the filter take in what was found. Returns the share of the belief
  /// that it got: 0 if nothing came in.
  double recover(RecoveryMemory& memory, const StreamModel& model, Time now, double probability,
                 PoseFilter& filter) const;

 private:
  bool due(const RecoveryMemory& memory, Time now, double probability) const;
  double share_of(const SearchFinding& finding, double probability) const;
  void take_in(const std::vector<LocatedPose>& poses, double share, std::uint32_t search,
               PoseFilter& filter) const;

  RecoveryOptions options_;
  std::uint64_t seed_;
};

}  // namespace cairn
