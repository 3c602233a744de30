#pragma once

#include "cairn/localization/stream_model.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/search/path_score.hpp"
#include "cairn/models/sensor/beam_selection.hpp"

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace cairn {

/// Finds a scanner's poses anywhere on a map. The map is prepared when that is first asked for.
class LaserLocator {
 public:
  struct Options {
    LikelihoodFieldOptions likelihood;
    OneShotOptions search;
    double further_beams = 10.0;  ///< as which each scan after the first counts, in independent beams
    double crowd_m = 0.0;  ///< search(): where most beams end nearer, something stands around the robot
    int joined = 8;        ///< locate(): so many of the last scans are searched with
  };

  LaserLocator(std::shared_ptr<const OccupancyGrid> map, const Pose2& T_base_sensor, const BeamLimits& limits,
               const Options& options)
      : map_(std::move(map)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

  /// Places from the last glimpses, and those asked for; all weighed by the whole way (score_path).
  std::vector<LocatedPose> locate(std::span<const Glimpse> glimpses, std::span<const Pose2> asked) const;
  /// Places from all glimpses joined; where people stand around the robot, also from the beams that pass
  /// between them.
  std::vector<LocatedPose> search(std::span<const Glimpse> glimpses) const;

 private:
  const PoseSearch& prepared() const;
  std::vector<Point2> joined(std::span<const Glimpse> glimpses, int beams, double farther_than_m = 0.0) const;
  double from_sensor(const Point2& p) const;
  bool surrounded(const Glimpse& glimpse) const;
  std::vector<LocatedPose> located(const std::vector<Point2>& points, std::size_t scans) const;
  std::vector<PathLook> looks(std::span<const Glimpse> glimpses) const;
  void weigh(std::span<const PathLook> path, std::vector<LocatedPose>& places) const;

  std::shared_ptr<const OccupancyGrid> map_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  Options options_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const PoseSearch> search_;
};

}  // namespace cairn
