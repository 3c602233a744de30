#include "apps/cairn/commands.hpp"
#include "apps/cairn/interrupt.hpp"
#include "apps/cairn/localize_metrics.hpp"
#include "apps/cairn/localize_run.hpp"
#include "apps/cairn/place_cache.hpp"
#include "apps/cairn/pose_option.hpp"
#include "apps/cairn/progress.hpp"
#include "apps/cairn/report_command.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/seed_option.hpp"
#include "apps/cairn/time_spans.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/recorder.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/maps/checksum.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string map;
  std::string log;
  std::vector<std::string> configs;
  std::vector<std::string> settings;
  std::string init;
  std::string init_error = "0,0,0";
  bool global = false;
  bool live = false;
  std::string spans;
  std::string reference;
  std::string seed = "1";
  int threads = 1;
  std::string out;
  bool no_record = false;
};

// What the arguments name, read.
struct Inputs {
  Log log;
  std::shared_ptr<const MapSet> maps;
  std::shared_ptr<const OccupancyGrid> map;  ///< the grid of `maps`
  StreamMaps stream_maps;
  LocalizerOptions options;
  std::optional<Trajectory> reference;
  Diagnostics diagnostics;
  double read_s = 0.0;
};

LocalizerOptions read_options(const Arguments& arguments, Diagnostics& diagnostics) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  for (const std::string& config : arguments.configs) {
    read_configuration(*open_input(config), config, visit, diagnostics);
  }
  apply_settings(arguments.settings, visit);
  options.validate();
  return options;
}

std::vector<Time> scan_stamps(const Log& log) {
  std::vector<Time> stamps;
  for (const Event& event : log.events) {
    if (log.streams[event.stream].kind == StreamKind::kLaserScan) stamps.push_back(event.stamp);
  }
  std::sort(stamps.begin(), stamps.end());  // of several lasers, or in the order of arrival
  return stamps;
}

// As the robot heard of them.
void sort_by_arrival(std::vector<Event>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
}

// Before the work of a long run, not after it.
void check_overlap(const std::string& path, const Trajectory& reference, const std::vector<Time>& scans) {
  if (reference.empty() || scans.empty()) return;
  const StampedPose& first = reference.front();
  const StampedPose& last = reference.back();
  if (first.stamp <= scans.back() && last.stamp >= scans.front()) return;
  throw InputError(
      path,
      fmt::format(
          "ends before the log's scans begin, or begins after they end ({} to {} s, scans {} to {} s)",
          format_time(first.stamp), format_time(last.stamp), format_time(scans.front()),
          format_time(scans.back())),
      "give the reference of the same run, in the same clock");
}

// A run over a part of a log: as if nothing had been recorded before and after it.
void keep_spans(const std::string& text, std::vector<Event>& events) {
  const TimeSpans spans("--spans", text);
  if (spans.everything() || events.empty()) return;
  const Time start = std::min_element(events.begin(), events.end(), [](const Event& a, const Event& b) {
                       return a.stamp < b.stamp;
                     })->stamp;
  std::erase_if(events, [&](const Event& event) { return !spans.contains(event.stamp - start); });
  if (events.empty()) throw ConfigurationError("--spans", "hold nothing of the log", "see `cairn log info`");
}

Inputs read_inputs(const Arguments& arguments) {
  const auto started = std::chrono::steady_clock::now();
  Inputs inputs;
  inputs.options = read_options(arguments, inputs.diagnostics);
  inputs.maps = read_map_set(arguments.map, inputs.diagnostics);
  inputs.map = inputs.maps->grid();
  make_stream_maps_absolute(inputs.options);
  inputs.stream_maps = read_stream_maps(inputs.options, inputs.diagnostics);
  inputs.log = read_log(arguments.log);
  keep_spans(arguments.spans, inputs.log.events);
  arguments.live ? sort_by_arrival(inputs.log.events) : void(sort_by_stamp(inputs.log));
  if (!arguments.reference.empty()) {
    const std::vector<Time> stamps = scan_stamps(inputs.log);
    inputs.reference = read_trajectory(arguments.reference, {.frame_stamps = stamps}, inputs.diagnostics);
    check_overlap(arguments.reference, *inputs.reference, stamps);
  }
  inputs.read_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return inputs;
}

// The odometry that the localizer will use, as a trajectory.
Trajectory odometry_of(const Inputs& inputs) {
  Trajectory odometry;
  std::optional<StreamId> stream;
  for (const Event& event : inputs.log.events) {
    const auto* sample = std::get_if<Odometry>(&event.payload);
    const std::string& wanted = inputs.options.odometry_stream;
    if (sample == nullptr || (!wanted.empty() && inputs.log.streams[event.stream].name != wanted)) continue;
    if (stream.value_or(event.stream) != event.stream) continue;
    stream = event.stream;
    odometry.push_back({sample->stamp, sample->T_odom_base});
  }
  sort_by_stamp(odometry);
  return odometry;
}

// Where the reference says that the robot was at the first scan; where it begins later, taken back from its
// first pose by the odometry.
Pose2 reference_start(const Inputs& inputs) {
  const std::vector<Time> stamps = scan_stamps(inputs.log);
  if (stamps.empty()) return inputs.reference->front().pose;
  if (const auto pose = pose_at(*inputs.reference, stamps.front())) return *pose;
  const StampedPose& first = inputs.reference->front();
  const Trajectory odometry = odometry_of(inputs);
  const auto at_scan = pose_at(odometry, stamps.front());
  const auto at_reference = pose_at(odometry, first.stamp);
  if (!at_scan || !at_reference) return first.pose;
  return first.pose * between(*at_reference, *at_scan);
}

Start choose_start(const Arguments& arguments, const Inputs& inputs) {
  if (arguments.init.empty()) return {};
  const Pose2 pose =
      arguments.init == "reference" ? reference_start(inputs) : parse_pose("--init", arguments.init);
  const Pose2 error = parse_pose("--init-error", arguments.init_error);
  return {Pose2{pose.x + error.x, pose.y + error.y, normalize_angle(pose.theta + error.theta)}};
}

RunData to_run_data(Inputs& inputs, const LocalizeResult& result, const nlohmann::json& metrics,
                    bool recorded) {
  RunData run;
  run.recorded = recorded;
  for (const Estimate& e : result.estimates) run.trajectory.push_back({e.stamp, e.T_map_base});
  sort_by_stamp(run.trajectory);
  run.estimates = result.estimates;
  run.metrics = metrics;
  run.configuration = write_configuration([&](OptionVisitor& v) { inputs.options.visit(v); });
  run.map = inputs.map;
  run.hypotheses = result.hypotheses;
  run.particles = result.snapshots;
  run.reference = inputs.reference;
  return run;
}

// Absolute, so that the run can be had again from another folder.
std::string absolute(const std::string& path) { return std::filesystem::absolute(path).lexically_normal(); }

std::unique_ptr<Recorder> make_recorder(const Arguments& arguments, const Inputs& inputs,
                                        const Start& start) {
  if (arguments.no_record) return nullptr;
  RunHeader header;
  header.cairn_version = CAIRN_VERSION;
  header.configuration =
      write_configuration([options = inputs.options](OptionVisitor& v) mutable { options.visit(v); });
  header.seed = parse_seed("--seed", arguments.seed);
  header.T_map_base = start.T_map_base;
  header.map_path = absolute(arguments.map);
  header.map_checksum = checksum(*inputs.maps);
  header.log_path = absolute(arguments.log);
  header.odometry_stream = inputs.options.odometry_stream;
  header.stream_map_checksums = checksums(inputs.stream_maps);
  header.live = arguments.live;
  return std::make_unique<Recorder>(prepare_recording(arguments.out), header, inputs.log.streams);
}

LocalizeResult run_with_progress(const Arguments& arguments, const Inputs& inputs) {
  const Start start = choose_start(arguments, inputs);
  LocalizeRequest request{
      .log = &inputs.log,
      .map = inputs.map,
      .maps = inputs.maps,
      .stream_maps = inputs.stream_maps,
      .options = inputs.options,
      .places = places_for(inputs.log, inputs.options, *inputs.maps, inputs.stream_maps, arguments.map),
      .start = start,
      .seed = parse_seed("--seed", arguments.seed),
      .threads = arguments.threads,
      .live = arguments.live};
  const auto recorder = make_recorder(arguments, inputs, start);
  if (recorder) {
    request.on_event = [&](const Event& event) { recorder->record(event); };
    request.on_estimate = [&](const Estimate& estimate) { recorder->record(estimate); };
  }
  Progress progress("localizing", static_cast<std::int64_t>(inputs.log.events.size()));
  const InterruptGuard interrupt;
  request.go_on = [&](std::int64_t done) {
    progress.update(done);
    return !interrupt.requested();
  };
  LocalizeResult result = localize(request);
  if (recorder) recorder->finish();
  return result;
}

// What can be refused before anything is read.
void check_arguments(const Arguments& arguments) {
  check_run_directory(arguments.out);
  const TimeSpans readable("--spans", arguments.spans);  // refuses what is none before anything is read
  parse_seed("--seed", arguments.seed);
  if (arguments.threads < 1 || arguments.threads > Executor::kMostThreads) {
    throw ConfigurationError("--threads", "is " + std::to_string(arguments.threads),
                             "use 1 to " + std::to_string(Executor::kMostThreads));
  }
  if (!arguments.init.empty() && arguments.init != "reference") parse_pose("--init", arguments.init);
  if (arguments.init == "reference" && arguments.reference.empty()) {
    throw ConfigurationError("--init reference", "there is no reference", "give one with --reference");
  }
  parse_pose("--init-error", arguments.init_error);
}

int run_localize(const Arguments& arguments) {
  check_arguments(arguments);
  Inputs inputs = read_inputs(arguments);
  const LocalizeResult result = run_with_progress(arguments, inputs);
  const RunSummary summary =
      summarize_run({.log_path = arguments.log,
                     .map_path = arguments.map,
                     .seed = parse_seed("--seed", arguments.seed),
                     .threads = arguments.threads,
                     .read_s = inputs.read_s,
                     .live = arguments.live},
                    inputs.log, *inputs.map, inputs.options, inputs.reference, inputs.diagnostics, result);
  write_run(arguments.out, to_run_data(inputs, result, summary.metrics, !arguments.no_record));
  const std::string no_report = write_report(arguments.out);
  if (!no_report.empty()) spdlog::warn("no report.html: {}", no_report);
  std::cout << summary.text << "written to " << arguments.out << "\n";
  if (result.interrupted) {
    spdlog::warn("interrupted: this is what was computed until then");
    return kFailed;
  }
  if (summary.lost) spdlog::error("the run ended lost: {}", summary.reason);
  return summary.lost ? kLost : kOk;
}

}  // namespace

void add_localize(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("localize", "Localize a recorded robot in a map");
  auto a = std::make_shared<Arguments>();
  command->add_option("--map", a->map, "Map (map_server YAML, Wean; vector map: text, GeoJSON, DXF)")
      ->required();
  command->add_option("--log", a->log, "Recording (CARMEN, ROS 1 or ROS 2 bag, MCAP, Wean, MRPT text)")
      ->required();
  command->add_option(
      "--config", a->configs,
      "Configuration (YAML; see `cairn config`; nav2 AMCL files too); of several the later win");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  auto* init = command->add_option(
      "--init", a->init, "Start pose x,y,yaw in the map (m, rad), or `reference`: where that begins");
  command->add_option("--init-error", a->init_error, "x,y,yaw added to the start pose (m, rad)")->needs(init);
  command->add_flag("--global", a->global, "Start anywhere free (the default)")->excludes(init);
  command->add_flag(
      "--live", a->live,
      "As on the robot: messages in the order of their arrival (default: of their stamps), and the "
      "trajectory "
      "is of the estimates that it had at each moment (default: of the beliefs at the scans' stamps)");
  command->add_option("--spans", a->spans,
                      "Only these parts of the log, for example 100-160 (seconds since its start)");
  command->add_option("--reference", a->reference,
                      "Trajectory taken as true: adds the accuracy to the results");
  command->add_option("--seed", a->seed, "Of all random numbers")->capture_default_str();
  command->add_option("--threads", a->threads, "Changes the time taken, never the results")
      ->capture_default_str();
  command->add_option("--out", a->out, "Folder for the results")->required();
  command->add_flag("--no-record", a->no_record,
                    "Do not write run.mcap, which `cairn replay` and Foxglove read");
  command->footer(
      "Exit code: 0 tracking to the end, 4 lost at the end (by the reference where there is one, else by "
      "what the run thinks of itself), 1 ended early by Ctrl-C (what was computed is written all the same), "
      "2 usage or configuration, 3 input that cannot be read.");
  command->callback([a, &run] { run = [a] { return run_localize(*a); }; });
}

}  // namespace cairn::app
