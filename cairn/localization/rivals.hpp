#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/localization/stream_model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn {

/// Another place where the robot may be instead of where it is believed.
struct Rival {
  Pose2 T_map_base;       ///< now
  double log_odds = 0.0;  ///< that it is there, against where it is believed; nat
  int scans = 0;          ///< that it has been weighed by since it was found
  double age_s = 0.0;     ///< since it was found
  std::uint32_t id = 0;   ///< the same as long as it is followed
};

/// How rivals gain and lose.
struct RivalRules {
  double beams = 6.0;     ///< a scan counts as this many independent beams
  double largest = 3.0;   ///< one scan never says more than this, nat
  double least = -12.0;   ///< rivals below these log-odds are given up
  std::size_t most = 30;  ///< the most probable so many are kept
  double same_m = 0.7;    ///< nearer places ...
  double same_rad = 0.4;  ///< ... turned by less than this are one
};

/// Places that compete with the belief from scan to scan, and beside it: they disturb no filter while the
/// evidence gathers. Each is carried by the odometry, put where the scan fits best nearby, and gains or loses
/// by how much better or worse the same scan fits there than where the robot is believed (sequential
/// probability ratio: Wald 1945). People around the robot spoil the fit of all places alike; only a wrong
/// place has a rival that gains. So are two corridors that look alike told apart: over the distance that it
/// takes, in favour of none until then.
class Rivals {
 public:
  explicit Rivals(const RivalRules& rules = {}) : rules_(rules) {}

  /// The robot has moved, and time has passed.
  static void carry(std::vector<Rival>& rivals, const Pose2& T_before_after, double since_s);

  /// Weighs all by one measurement; those that became hopeless, or that have come to be a better rival, are
  /// given up; the believed place takes over the odds of one that has come to be it. Nothing changes where
  /// the model cannot follow places.
  /// @param news 0 to 1: how much of it is not what was seen before
  void weigh(std::vector<Rival>& rivals, const StreamModel& model, const Event::Payload& z,
             const Pose2& believed, double news = 1.0) const;

  /// Adds what a search found. A place that is known already keeps its log-odds: they rest on more scans.
  void add(std::vector<Rival>& rivals, const Rival& found, const Pose2& believed) const;

  /// What a scan says for a place where it fits so well, 0 at most and -largest at least, nat. The floor is
  /// that of each place, not of their difference: where the belief is quite wrong, rivals still differ.
  double evidence(double fit) const;

  /// The strongest of those that have been weighed by at least so many scans; nullptr: there is none.
  static Rival* strongest(std::vector<Rival>& rivals, int scans);

  /// `winner`, one of the rivals, becomes what is believed, and the place believed so far its rival.
  /// Returns what it was.
  Rival take_over(std::vector<Rival>& rivals, Rival& winner, const Pose2& believed) const;

  /// Probability of a place with these log-odds against the believed one, if the robot is at one of the
  /// rivals or there. Any odds, however large.
  static double share(const std::vector<Rival>& rivals, double log_odds);
  /// That of the believed place.
  static double believed_share(const std::vector<Rival>& rivals) { return share(rivals, 0.0); }

 private:
  bool same(const Pose2& a, const Pose2& b) const;
  void merge(std::vector<Rival>& rivals, const Pose2& believed) const;
  void prune(std::vector<Rival>& rivals, const Pose2& believed) const;

  RivalRules rules_;
};

}  // namespace cairn
