#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/time.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/localization/rivals.hpp"
#include "cairn/localization/stream_model.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cairn {

/// When and how a lost robot is looked for.
struct RecoveryOptions {
  bool active = true;
  double doubt = 0.9;     ///< in doubt while the pose is right with less than this probability,
  double drop = 0.15;     ///< and where the map explains by this share fewer beams than usual
  double surprise = 0.3;  ///< a scan of which it explains by this less than of the last is worth an update
  double prior = 0.05;    ///< probability of being elsewhere when doubt begins, shared by what is found
  double news_m = 0.25;   ///< way after which a scan is news; one taken nearer to the last says less
  double every_s = 2.0;   ///< time between two searches, doubled after each that finds nothing new
  double at_most_every_s = 4.0;   ///< up to this
  int scans = 8;                  ///< of the last ones that may be joined
  double spacing_m = 0.2;         ///< those nearer to the one before than this ...
  double spacing_rad = 0.2;       ///< ... and turned by less than this are left out, but for the newest
  int most_poses = 40;            ///< distinct places
  double sigma_hit_m = 0.15;      ///< as laser.sigma_hit_m, in the search
  double effective_beams = 12.0;  ///< as laser.effective_beams, for the first of the joined scans
  double further_beams = 5.0;     ///< likewise for each of the others
  double crowd_m = 1.0;  ///< where most beams end nearer, a second search takes those beyond; 0: never
  double millions_of_points = 10;  ///< a search looks up at most this many million end points
  double rival_beams = 10.0;       ///< as laser.effective_beams, for a scan that rivals are weighed by
  double rival_most = 10.0;        ///< a scan never speaks more than this against a place, nat
  double accept = 4.0;             ///< log-odds at which a rival takes over
  double sure = 8.0;               ///< (and so many more while the pose is right with at least `doubt`),
  int confirm = 1;                 ///< after so many scans that have weighed it since it was found,
  double share = 0.9;              ///< with this probability among all places;
  double refuted = 0.25;           ///< where this share of the beams ends behind walls or off the map,
  double refuted_accept = 1.0;     ///< these log-odds ...
  double refuted_share = 0.6;      ///< ... and this probability are enough, at once. Against a belief that
  double hopeless = 10.0;          ///< has lost by so much that the best of two or three is better,
  /// Where a scan does not go on where the one before left off (less than this share of it does), the robot
  /// may have been carried away. 0: this is not looked at.
  double continued = 0.75;
  double carried = 0.5;   ///< prior of being elsewhere then, shared by what is found
  double anchor_m = 2.0;  ///< after so much way on which all scans went on, places elsewhere are given up;
  double settle_m = 6.0;  ///< after so much where a rival has taken over
  /// The first search prepares the map, for about 60 bytes per cell: there is no recovery on a larger one,
  /// and a warning says so.
  double most_million_cells = 16.0;

  void visit(OptionVisitor& visitor);
};

/// How the believed pose stands, whatever its rivals say.
enum class Standing {
  kTrusted,   ///< the monitor has no doubt: people in the way may be all that is wrong
  kDoubtful,  ///< it has
  kRefuted,   ///< the last scan alone is impossible there: its beams would have passed through walls
};

/// Whether a scan goes on where the one before left off.
enum class Link {
  kUnknown,  ///< nothing to compare it with
  kHolds,
  kBroken,  ///< the robot may have been carried away
};

/// All that changes in a recovery.
struct RecoveryMemory {
  std::vector<Glimpse> glimpses;  ///< since the pose came into doubt, the newest last
  std::uint32_t stream = 0;       ///< that they are of
  std::vector<Rival> rivals;
  bool searched = false;
  Time searched_at;
  double wait_s = 0.0;
  std::uint32_t searches = 0;
  std::uint32_t takeovers = 0;
  std::uint32_t last_id = 0;  ///< of the rivals
  int doubtful = 0;           ///< scans for which the doubt goes on
  double moved_m = 0.0;       ///< since the last scan that rivals were weighed by; 1 rad counts as 1 m
  double proven_m = 0.0;      ///< way since anything last spoke against having tracked the robot; likewise
  double doubted_m = 0.0;     ///< way on which the pose has been doubtful without a break; likewise
  double settled_at_m = 0.0;  ///< `proven_m` that settles where the robot is
  bool carried = false;       ///< a link broke, and it is not settled where the robot is
};

/// Brings a robot that was carried away back. While the pose is in doubt, global localization from the scans
/// since then finds other places. Each begins as a rival of the believed one with the prior log-odds of being
/// lost, plus what those scans fit better there than where the robot is believed. From then on rivals and
/// belief compete from scan to scan (rivals.hpp). The belief is left alone until one of them wins, against it
/// and against all others: where two places fit alike, none does. Scans count as far as they are news: what
/// stands in the way is seen again and again from nearby (decision 95).
/// Immutable; deterministic: a function of the measurements in their order.
class Recovery {
 public:
  Recovery(const RecoveryOptions& options, std::uint64_t seed)
      : options_(options),
        rivals_({.beams = options.rival_beams, .largest = options.rival_most}),
        seed_(seed) {}

  /// Whether a scan makes the pose doubtful.
  /// @param right probability of the pose, the scan included
  /// @param explained share of its beams that the map explains there; usual: the average so far
  bool doubtful(double right, double explained, double usual) const;
  /// @param seen classes of the scan's beams at the believed pose, if it has any; fewer than `rival_beams` of
  /// them refute nothing
  Standing standing(double right, const std::optional<BeamShares>& seen) const;
  /// Whether a scan is worth an update though the robot has not moved: it is not what was seen here before.
  bool surprising(double explained_before, double explained_now) const;

  /// @param continued share of a scan that goes on where the one before left off, if that can be told
  Link link(const std::optional<double>& continued) const;
  /// What it begins with. @param anywhere false: the start pose was given
  RecoveryMemory begin(bool anywhere) const;
  /// Takes note of how a scan goes on. Where it does not, what was seen and found before is of another place.
  void note(RecoveryMemory& memory, Link link, Time now) const;
  /// Whether the robot has been tracked to where it is believed, scan by scan: then it cannot be far away,
  /// however much better other places explain what is seen (decision 99).
  bool anchored(const RecoveryMemory& memory) const;
  /// Whether the map has had its say as well, for as much way again (a start pose that was given may be
  /// wrong): what ends off the map says nothing then.
  bool well_tracked(const RecoveryMemory& memory) const;
  /// The belief after a measurement: what it has proven, and whether that settles where the robot is.
  /// @param vouched another scanner speaks for the pose: what this one says does not disprove it
  void settle(RecoveryMemory& memory, double right, Standing standing, bool vouched = false) const;

  /// Nothing is proven: something else tells where the robot may be.
  static void unsettle(RecoveryMemory& memory);

  /// The robot has moved.
  static void carry(RecoveryMemory& memory, const Pose2& T_before_after, double since_s);
  /// Remembers a measurement and weighs the rivals by it.
  /// @param in_doubt whether it or the ones before speak against the pose
  void observe(RecoveryMemory& memory, StreamId stream, const StreamModel& model, const Event::Payload& z,
               const Pose2& believed, bool in_doubt) const;

  /// Searches, if it is time to.
  void search(RecoveryMemory& memory, const StreamModel& model, Time now, const Pose2& believed) const;

  /// Covariance of a rival that takes over.
  static Eigen::Matrix3d spread();
  /// Lets a rival that has won take over: the filter begins anew there, and the places believed so far are
  /// rivals with the odds that they have left. False if none has. @param places of the filter, the believed
  /// one first
  bool take_over(RecoveryMemory& memory, std::span<const Hypothesis> places, Standing standing,
                 PoseFilter& filter) const;

 private:
  void remember(RecoveryMemory& memory, StreamId stream, const Event::Payload& z, bool in_doubt) const;
  bool has_won(const RecoveryMemory& memory, const Rival& rival, Standing standing) const;
  void begin_at(const Pose2& mean, std::uint32_t takeover, PoseFilter& filter) const;
  bool due(const RecoveryMemory& memory, Time now) const;

  RecoveryOptions options_;
  Rivals rivals_;
  std::uint64_t seed_;
};

}  // namespace cairn
