#pragma once

#include "cairn/core/options.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/localization/judgement.hpp"
#include "cairn/models/sensor/beam_classes.hpp"
#include "cairn/sensing/event.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cairn {

/// How the figures of one scan speak for or against the pose, in nat of log-odds; one set for all sensors and
/// maps. Chosen by hand from the figures of right and wrong poses in seven data sets (decision 90);
/// `scripts/calibrate_monitor` fits and judges them on the runs of `cairn kidnap`.
struct MonitorOptions {
  double bias = -5.5;
  double explained = 7.0;      ///< per share of beams
  double blocked = 5.5;        ///< likewise
  double beyond = -7.0;        ///< likewise
  double fit = 0.0;            ///< per nat and beam
  double drop = 0.0;           ///< per share by which fewer beams are explained than usual here
  double innovation = -2.0;    ///< per metre, up to 1 m
  double largest = 2.0;        ///< one scan never says more than this
  double lost_rate = 1e-3;     ///< prior probability of being carried away between two updates
  double found_rate = 1e-2;    ///< likewise of a lost filter coming right by itself
  double scale = 1.0;          ///< of the reported log-odds
  double drift_m = 0.7;        ///< drift that halves the probability; 0: none does
  double usual_memory = 0.98;  ///< share of the usual figures that outlives an update while the pose is right
  double crowded_share = 0.35;    ///< state crowded above this share of blocked beams
  double ambiguous_weight = 0.9;  ///< state ambiguous below this weight of the believed place
  double ambiguous_m = 1.0;       ///< or above this standard deviation of the position
  int blind_scans = 5;            ///< state sensor_fault after so many scans without a usable beam

  void visit(OptionVisitor& visitor);
};

/// What one update tells the monitor.
struct MonitorInput {
  StreamId stream = 0;
  std::optional<BeamShares> seen;      ///< nullopt: this sensor cannot tell classes of beams
  double quality = 0.0;                ///< used instead: share that the map explains
  std::span<const Hypothesis> places;  ///< the believed one first
  double innovation_m = 0.0;           ///< see Judgement
  double drift_m = 0.0;                ///< likewise
  double share = 1.0;    ///< of the scan's beams that `seen` is about: so much its evidence counts
  bool vouched = false;  ///< for the pose by another scanner: what this one says against it does not count
};

/// All that changes in a monitor.
struct MonitorMemory {
  struct Stream {
    double usual_explained = -1.0;  ///< none yet
    double usually_against = 0.0;   ///< evidence against poses that another scanner vouches for, mean
    int blind = 0;                  ///< scans in a row without a usable beam
  };
  std::vector<Stream> streams;
  double log_odds = 0.0;       ///< that the believed place is the right one, but for the other places
  double last_evidence = 0.0;  ///< of the last scan, for the pose
  double blocked = 0.0;        ///< share, averaged over some scans
  double drift_m = 0.0;        ///< of the last update
};

/// Judges from update to update whether the reported pose is right: a Bayes filter over {right, lost}.
/// Between updates the robot may be carried away (lost_rate); each scan adds its log-likelihood ratio, linear
/// in the shares of beams that the map explains, that are blocked before and that pass through walls, in the
/// fit, in how far the explained share has fallen below what is usual for this sensor and map, and in the
/// innovation. A crowd blocks beams; a wrong place lets them through walls.
///
/// The reported probability is that of being right times the weight of the believed place. Where the map has
/// taken the pose elsewhere than the robot has moved, by a drift of d metres (Reckoning), it is divided by
/// 1 + (d / drift_m)^6; that does not add up from scan to scan. Immutable; deterministic; does not allocate
/// after the first update of a stream.
class Monitor {
 public:
  explicit Monitor(const MonitorOptions& options) : options_(options) {}

  /// @param streams of the table; a robot that may be anywhere begins with even odds
  static MonitorMemory begin(std::size_t streams, bool anywhere);

  Judgement update(MonitorMemory& memory, const MonitorInput& input) const;

  /// Probability that the believed place is right, if it is one of those that the belief holds.
  double right(const MonitorMemory& memory) const;
  /// Likewise by what the scans say, whatever the drift.
  double right_by_scans(const MonitorMemory& memory) const;

  /// Another place is believed now, or candidates came in: what was known of the old one is void.
  static void start_over(MonitorMemory& memory);
  /// Likewise, and the other one has won against all that are known (Recovery::take_over).
  static void take_over(MonitorMemory& memory);
  /// Whether the map fits the scanner: it does not speak against what others vouch for, scan after scan.
  static bool fits(const MonitorMemory& memory, StreamId stream);
  /// No other scanner is left to say so.
  static void believe(MonitorMemory& memory, StreamId stream);
  /// Puts the shares of the whole scan into the judgement.
  static void describe(const BeamShares& seen, Judgement& judgement);

 private:
  double evidence(const MonitorInput& input, double usual) const;
  double counted(double evidence, bool vouched, MonitorMemory::Stream& stream) const;
  TrackingState state(const MonitorMemory& memory, const MonitorInput& input) const;

  MonitorOptions options_;
};

/// The reason of a judgement in one sentence.
std::string explain(const Judgement& judgement);

}  // namespace cairn
