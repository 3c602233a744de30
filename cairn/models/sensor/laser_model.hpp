#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/sensing/laser_scan.hpp"

namespace cairn {

/// A sensor model of laser scans, as a localizer knows it. States are T_map_base.
class LaserModel : public SensorModel<Pose2, LaserScan> {
 public:
  /// Share of the evaluated beams that the map explains, seen from `T_map_base`: 0..1; 0 without a valid
  /// beam. Each model says what it counts as explained.
  virtual double explained_share(const LaserScan& scan, const Pose2& T_map_base) const = 0;

  /// True if beams without return count, too: then a scan of an open place tells where the robot may be.
  virtual bool reads_no_returns() const { return false; }
};

}  // namespace cairn
