#pragma once

#include "apps/cairn/posed_scans.hpp"
#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"
#include "cairn/maps/grid_builder.hpp"
#include "cairn/maps/ndt_map.hpp"

#include <functional>
#include <optional>
#include <string>

namespace cairn::app {

struct MapBuildingOptions {
  GridBuilderOptions grid;
  PosedScanOptions scans;
};

struct BuiltMap {
  OccupancyGrid grid;
  std::size_t scans_used = 0;
  std::size_t scans_without_pose = 0;    ///< outside the trajectory or in one of its gaps
  std::size_t scans_without_return = 0;  ///< no valid beam
};

/// Stamps of one stream's events, in the order of the log: the frames that a numbered path counts.
std::vector<Time> stamps_of(const Log& log, StreamId stream);

/// Builds a map from the scans of a log and the path that the robot took.
/// @param progress  called now and then with the share that is done, 0..1
/// @throws ConfigurationError if the mounting pose is needed and nobody tells it; InputError if no scan has a
/// pose
BuiltMap build_map(const Log& log, const Trajectory& trajectory, const MapBuildingOptions& options,
                   const std::function<void(double)>& progress);

/// The walls of the scans as normal distributions, with their occupancies (ONDT). Beams beyond
/// `options.grid.max_range_m` are left out.
/// @throws as build_map
NdtMap build_ndt(const Log& log, const Trajectory& trajectory, const MapBuildingOptions& options,
                 const NdtMapOptions& ndt);

}  // namespace cairn::app
