#include "apps/cairn/commands.hpp"
#include "apps/cairn/map_ambiguity.hpp"
#include "apps/cairn/map_building.hpp"
#include "apps/cairn/map_convert.hpp"
#include "apps/cairn/ndt_output.hpp"
#include "apps/cairn/output_file.hpp"
#include "apps/cairn/posed_scan_arguments.hpp"
#include "apps/cairn/progress.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/maps/checksum.hpp"

#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kProgressSteps = 1000;

struct BuildArguments {
  std::string log, trajectory, out;
  PosedScanArguments scans;
  MapBuildingOptions options;
  NdtMapOptions ndt;
};

struct InfoArguments {
  std::string map;
  bool json = false;
};

void warn_of(const std::string& path, const Diagnostics& diagnostics) {
  for (const auto& [kind, count] : diagnostics.counts()) spdlog::warn("{}: {} ({} times)", path, kind, count);
}

MapBuildingOptions options_of(const BuildArguments& arguments) {
  MapBuildingOptions options = arguments.options;
  options.scans = arguments.scans.options();
  return options;
}

Trajectory read_path(const BuildArguments& arguments, const Log& log, StreamId stream) {
  Diagnostics diagnostics;
  TrajectoryOptions options;
  options.frame_stamps = stamps_of(log, stream);
  Trajectory path = read_trajectory(arguments.trajectory, options, diagnostics);
  warn_of(arguments.trajectory, diagnostics);
  return path;
}

BuiltMap build_with_progress(const Log& log, const Trajectory& path, const MapBuildingOptions& options) {
  Progress progress("building the map", kProgressSteps);
  return build_map(log, path, options, [&progress](double done) {
    progress.update(static_cast<std::int64_t>(kProgressSteps * done));
  });
}

int run_build(const BuildArguments& arguments) {
  const MapBuildingOptions options = options_of(arguments);
  prepare_output_file(arguments.out);
  const Log log = read_log(arguments.log);
  warn_of(arguments.log, log.diagnostics);
  const Trajectory path = read_path(arguments, log, laser_stream(log, options.scans.stream));
  if (std::filesystem::path(arguments.out).extension() == ".ndt") {
    write_ndt_map(arguments.out, build_ndt(log, path, options, arguments.ndt));
    return kOk;
  }
  const BuiltMap map = build_with_progress(log, path, options);
  if (map.scans_without_pose > 0) {
    spdlog::warn("{} of {} scans have no pose in the trajectory and were left out", map.scans_without_pose,
                 map.scans_without_pose + map.scans_used + map.scans_without_return);
  }
  write_map(arguments.out, map.grid);
  spdlog::info("{}: {} x {} cells of {} m from {} scans", arguments.out, map.grid.geometry().width,
               map.grid.geometry().height, options.grid.resolution_m, map.scans_used);
  return kOk;
}

/// What `map info` says of a map.
struct MapFigures {
  explicit MapFigures(const OccupancyGrid& grid)
      : geometry(grid.geometry()),
        free(grid.count(CellState::kFree)),
        occupied(grid.count(CellState::kOccupied)),
        unknown(grid.count(CellState::kUnknown)),
        sum(fmt::format("{:016x}", checksum(grid))) {}
  double share(std::size_t count) const {
    return static_cast<double>(count) / static_cast<double>(geometry.size());
  }
  double free_area_m2() const {
    return static_cast<double>(free) * geometry.resolution_m * geometry.resolution_m;
  }
  double width_m() const { return geometry.width * geometry.resolution_m; }
  double height_m() const { return geometry.height * geometry.resolution_m; }

  GridGeometry geometry;
  std::size_t free, occupied, unknown;
  std::string sum;
};

std::string as_json(const MapFigures& f) {
  const Pose2& T = f.geometry.T_map_grid;
  const Json all = {{"width_cells", f.geometry.width},
                    {"height_cells", f.geometry.height},
                    {"resolution_m", f.geometry.resolution_m},
                    {"width_m", f.width_m()},
                    {"height_m", f.height_m()},
                    {"origin", {{"x_m", T.x}, {"y_m", T.y}, {"yaw_rad", T.theta}}},
                    {"free_share", f.share(f.free)},
                    {"occupied_share", f.share(f.occupied)},
                    {"unknown_share", f.share(f.unknown)},
                    {"free_area_m2", f.free_area_m2()},
                    {"checksum", f.sum}};
  return all.dump(2) + "\n";
}

std::string as_text(const MapFigures& f) {
  const Pose2& T = f.geometry.T_map_grid;
  return fmt::format("size      {} x {} cells of {} m: {:.2f} x {:.2f} m\n", f.geometry.width,
                     f.geometry.height, f.geometry.resolution_m, f.width_m(), f.height_m()) +
         fmt::format("origin    x {:.3f} m, y {:.3f} m, yaw {:.4f} rad (outer corner, lower left)\n", T.x,
                     T.y, T.theta) +
         fmt::format("free      {:.2f} % ({:.1f} m2)\n", 100 * f.share(f.free), f.free_area_m2()) +
         fmt::format("occupied  {:.2f} %\nunknown   {:.2f} %\nchecksum  {}\n", 100 * f.share(f.occupied),
                     100 * f.share(f.unknown), f.sum);
}

int run_info(const InfoArguments& arguments) {
  Diagnostics diagnostics;
  const AnyMap map = read_any_map(arguments.map, diagnostics);
  warn_of(arguments.map, diagnostics);
  if (const auto* ndt = std::get_if<std::shared_ptr<const NdtMap>>(&map)) {
    std::cout << describe(**ndt, arguments.json);
    return kOk;
  }
  if (const auto* walls = std::get_if<std::shared_ptr<const VectorMap>>(&map)) {
    std::cout << describe(**walls, arguments.json);
    return kOk;
  }
  const MapFigures figures(*std::get<std::shared_ptr<const OccupancyGrid>>(map));
  std::cout << (arguments.json ? as_json(figures) : as_text(figures));
  return kOk;
}

void add_build(CLI::App& parent, Runner& run) {
  auto* command = parent.add_subcommand("build", "Occupancy map from a log and the path that the robot took");
  auto a = std::make_shared<BuildArguments>();
  GridBuilderOptions& grid = a->options.grid;
  command->add_option("--log", a->log, "Log with laser scans, as for `cairn localize`")->required();
  command->add_option("--trajectory", a->trajectory, "Poses in the map, in the log's clock")->required();
  command
      ->add_option("--out", a->out,
                   "Map to write: NAME.yaml (its picture becomes NAME.png), or NAME.ndt: normal "
                   "distributions; a map uses "
                   "them where its YAML file has a line `ndt: NAME.ndt`")
      ->required();
  add_posed_scan_options(*command, a->scans);
  command->add_option("--resolution", grid.resolution_m, "Cell size, m")->capture_default_str();
  command->add_option("--ndt-cell", a->ndt.cell_size_m, "Cell size of NAME.ndt, m")->capture_default_str();
  command->add_option("--max-range", grid.max_range_m, "Use beams up to here, m");
  command
      ->add_option("--occupied-share", grid.occupied_share,
                   "Occupied if this share of the scans that see a cell end in it")
      ->capture_default_str();
  command->add_option("--min-observations", grid.min_observations, "Scans that must have seen a cell")
      ->capture_default_str();
  command->callback([a, &run] {
    // A cell that is not occupied is free: the two shares only differ where a program sets them apart.
    a->options.grid.free_share = a->options.grid.occupied_share;
    run = [a] { return run_build(*a); };
  });
}

void add_info(CLI::App& parent, Runner& run) {
  auto* command = parent.add_subcommand("info", "Size, place, shares and checksum of a map");
  auto a = std::make_shared<InfoArguments>();
  command->add_option("MAP", a->map, "map_server YAML file, Wean map, or vector map (text, GeoJSON, DXF)")
      ->required();
  command->add_flag("--json", a->json, "Print JSON (m, rad)");
  command->callback([a, &run] { run = [a] { return run_info(*a); }; });
}

}  // namespace

void add_map(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("map", "Make and inspect maps");
  command->require_subcommand(0, 1);
  add_build(*command, run);
  add_info(*command, run);
  add_map_convert(*command, run);
  add_map_ambiguity(*command, run);
}

}  // namespace cairn::app
