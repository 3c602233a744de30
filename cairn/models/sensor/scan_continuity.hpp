#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <optional>

namespace cairn {

struct ScanContinuityOptions {
  int beams = 60;        ///< of the later scan that are looked at, spread evenly over the valid ones
  int least_beams = 15;  ///< fewer in view of the earlier one say nothing
  /// How far an end point may be from the outline that was seen before: so much, and for each metre of its
  /// range, each metre driven, and each radian turned per metre of range so much more. Turns are the worst:
  /// scans and odometry are seldom stamped alike.
  double tolerance_m = 0.15;
  double per_range = 0.02;
  double per_way = 0.2;
  double per_turn = 0.3;
  double least_view_rad = 2.0;  ///< scanners that see less are not asked: one person may fill their view
  double gap_m = 0.5;           ///< neighbouring end points that are nearer than this are joined by a line
  double doubt = 0.95;          ///< where less of the later scan lies there, the earlier one is asked, too
  double most_m = 0.5;      ///< scans that are farther apart than this, or turned by more, are not compared:
  double most_rad = 0.5;    ///< corners hide too much
  int compared_beams = 30;  ///< as beams, where only motions are compared
  double most_compared_m = 1.0;    ///< likewise where only motions are compared
  double most_compared_rad = 1.0;  ///< likewise
};

/// Whether a robot has been carried away between two scans: then the later one does not go on where the
/// odometry says. No map is needed, so that it tells two corridors apart that look alike on the map (there,
/// widths and angles are alike, doors and the place between the walls are not), and a map that is wrong does
/// not spoil it.
///
/// Of consecutive scans of six recordings 0 to 0.5 % have a share below 0.75, of pairs from different places
/// of the same recording 96 to 100 % (tests/golden/scan_continuity_test.cpp). A robot that is carried slowly
/// while its scanner runs gives scans that do go on. Immutable.
class ScanContinuity {
 public:
  ScanContinuity(const Pose2& T_base_sensor, const BeamLimits& limits,
                 const ScanContinuityOptions& options = {})
      : T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

  /// Whether a scan sees enough to be compared.
  bool can_tell(const LaserScan& scan) const;

  /// Share of the later scan's end points in view of the earlier one that lie on what that one saw: 0..1.
  /// Where it leaves a doubt, that of the earlier one's on what the later one saw, if it is less: a scan of a
  /// recess may lie on the walls around it, but not the other way round. nullopt: they are too far apart, or
  /// too few. @param T_before_now motion of the base, by odometry
  std::optional<double> share(const LaserScan& before, const LaserScan& now, const Pose2& T_before_now) const;

  /// How closely the later scan lies on what the earlier one saw, to tell by which motion it does so best:
  /// mean over its end points in view of 1 within 5 cm, 3/4 within 10, 1/2 within 20, 1/4 within 40 cm, else
  /// 0. nullopt: as above. @param T_before_now motion of the base
  std::optional<double> closeness(const LaserScan& before, const LaserScan& now,
                                  const Pose2& T_before_now) const;

 private:
  std::optional<double> share_on(const LaserScan& seen, const LaserScan& scan,
                                 const Pose2& T_seen_scan) const;

  Pose2 T_base_sensor_;
  BeamLimits limits_;
  ScanContinuityOptions options_;
};

}  // namespace cairn
