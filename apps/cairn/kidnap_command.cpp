#include "apps/cairn/commands.hpp"
#include "apps/cairn/kidnap_evidence.hpp"
#include "apps/cairn/kidnap_run.hpp"
#include "apps/cairn/output_file.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/seed_option.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/executor.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string map, log, reference, other_log, other_reference;
  std::vector<std::string> configs, settings;
  int events = 20;
  KidnapOptions kidnap;
  std::string seed = "1";
  int jobs = 1;
  std::string out;
};

struct Recording {
  Log log;
  Trajectory reference;
  PosedLog posed() const { return {&log, &reference}; }
};

Recording read_recording(const std::string& log, const std::string& reference) {
  Recording recording{read_log(log), {}};
  sort_by_stamp(recording.log);
  TrajectoryOptions options;
  for (const Event& event : recording.log.events) {
    if (recording.log.streams[event.stream].kind == StreamKind::kLaserScan)
      options.frame_stamps.push_back(event.stamp);
  }
  Diagnostics diagnostics;
  recording.reference = read_trajectory(reference, options, diagnostics);
  if (recording.log.events.empty() || recording.reference.empty())
    throw InputError(log, "it or its reference is empty", "give a recording and the reference of that run");
  return recording;
}

LocalizerOptions read_options(const Arguments& arguments) {
  LocalizerOptions options;
  Diagnostics diagnostics;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  for (const std::string& config : arguments.configs)
    read_configuration(*open_input(config), config, visit, diagnostics);
  apply_settings(arguments.settings, visit);
  options.validate();
  return options;
}

/// One run: spliced, or the whole recording.
struct Run {
  std::string name;
  Kidnapping kidnapping;
  KidnapOutcome outcome;
  std::vector<JudgedEstimate> estimates;
  Time kidnapped;
  std::optional<double>
      truth_log_odds;  ///< what the first kToldWithin_s say for the truth, if it is not found
};
constexpr double kToldWithin_s = 10.0;

class Campaign {
 public:
  explicit Campaign(const Arguments& arguments)
      : arguments_(arguments),
        options_(read_options(arguments)),
        seed_(parse_seed("--seed", arguments.seed)) {
    arguments_.kidnap.odometry_stream = options_.odometry_stream;
    Diagnostics diagnostics;
    maps_ = read_map_set(arguments.map, diagnostics);
    first_ = read_recording(arguments.log, arguments.reference);
    const bool other = !arguments.other_log.empty();
    second_ = other ? read_recording(arguments.other_log, arguments.other_reference) : first_;
  }

  std::vector<Run> run() const {
    const auto chosen =
        choose_kidnappings(first_.posed(), second_.posed(), arguments_.events, seed_, arguments_.kidnap);
    if (chosen.empty() && arguments_.events > 0)
      throw ConfigurationError("--events", "the recording has no two places for a kidnapping",
                               "ask for less: --before, --after (s), --distance (m)");
    std::vector<Run> runs(std::max<std::size_t>(chosen.size(), arguments_.events == 0 ? 1 : 0));
    const Executor executor(arguments_.jobs);
    executor.for_each_chunk(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) runs[i] = chosen.empty() ? whole() : spliced(chosen[i], i);
    });
    return runs;
  }

 private:
  Run spliced(const Kidnapping& kidnapping, std::size_t index) const {
    const Splice joined = splice(first_.posed(), second_.posed(), kidnapping, arguments_.kidnap);
    Run run{fmt::format("event{:03}", index), kidnapping, {}, {}, joined.kidnapped, {}};
    run.estimates = localized(joined.log, joined.reference, seed_ + index);
    run.outcome = judge_kidnapping(run.estimates, joined.kidnapped);
    run.truth_log_odds = truth_log_odds(joined, run.estimates);
    return run;
  }

  std::optional<double> truth_log_odds(const Splice& joined, const std::vector<JudgedEstimate>& run) const {
    const Time until = joined.kidnapped + duration_from_seconds(kToldWithin_s);
    const auto after = std::find_if(run.begin(), run.end(),
                                    [&](const JudgedEstimate& e) { return e.estimate.stamp > until; });
    if (after == run.begin() || std::prev(after)->right()) return std::nullopt;
    const Estimate& last = std::prev(after)->estimate;
    return evidence_for_truth(joined.log.events,
                              bind_streams(options_, joined.log.streams, MapLibrary(maps_)), joined.reference,
                              {joined.kidnapped, last.stamp, last.T_map_base}, options_.recovery);
  }

  Run whole() const {
    Run run{"whole", {}, {}, {}, first_.log.events.back().stamp, {}};
    run.kidnapping.from = run.kidnapping.to = run.kidnapped;
    Log log = first_.log;
    std::erase_if(log.events, [&](const Event& e) { return e.stamp < first_.reference.front().stamp; });
    run.estimates = localized(log, first_.reference, seed_);
    run.outcome = judge_kidnapping(run.estimates, run.kidnapped);
    return run;
  }

  std::vector<JudgedEstimate> localized(const Log& log, const Trajectory& reference,
                                        std::uint64_t seed) const {
    LocalizeRequest request;
    request.log = &log;
    request.map = maps_->grid();
    request.maps = maps_;
    request.options = options_;
    request.start.T_map_base = reference.front().pose;
    request.seed = seed;
    return judge_run(localize(request), reference);
  }

  Arguments arguments_;
  LocalizerOptions options_;
  std::uint64_t seed_;
  std::shared_ptr<const MapSet> maps_;
  Recording first_, second_;
};

std::string events_csv(const std::vector<Run>& runs) {
  std::string text =
      "event,from_s,to_s,distance_m,right_before,lost_after_s,found_after_s,sure_and_wrong_s,false_alarms,"
      "before_s,truth_log_odds\n";
  for (const Run& r : runs) {
    const double before_s =
        r.estimates.empty() ? 0.0 : to_seconds(r.kidnapped - r.estimates.front().estimate.stamp);
    text += fmt::format("{},{},{},{:.2f},{:d},{:.3f},{:.3f},{:.3f},{},{:.1f},{}\n", r.name,
                        format_time(r.kidnapping.from), format_time(r.kidnapping.to), r.kidnapping.distance_m,
                        r.outcome.right_before, r.outcome.lost_after_s, r.outcome.found_after_s,
                        r.outcome.sure_and_wrong_s, r.outcome.false_alarms, before_s,
                        r.truth_log_odds ? fmt::format("{:.2f}", *r.truth_log_odds) : "");
  }
  return text;
}

std::string updates_csv(const std::vector<Run>& runs) {
  std::string text =
      "event,after_s,error_m,error_rad,right,state,probability,explained,blocked,beyond,fit,innovation_m,"
      "weight,place,quality,among,drift_m\n";
  for (const Run& r : runs) {
    for (const JudgedEstimate& e : r.estimates) {
      const Judgement& j = e.estimate.judgement;
      text += fmt::format(
          "{},{:.3f},{:.3f},{:.3f},{:d},{},{:.5f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.4f},{:d},{:"
          ".4f}\n",
          r.name, to_seconds(e.estimate.stamp - r.kidnapped), e.error_m, e.error_rad, e.right(),
          to_string(j.state), j.probability, j.explained, j.blocked, j.beyond, j.fit, j.innovation, e.weight,
          e.place, e.estimate.quality, e.among, j.drift);
    }
  }
  return text;
}

std::string summary_of(const std::vector<Run>& runs) {
  std::vector<double> found, lost;
  int within = 0, alarms = 0, counted = 0;
  double before_s = 0.0;
  for (const Run& r : runs) {
    alarms += r.outcome.false_alarms;
    if (!r.estimates.empty()) before_s += to_seconds(r.kidnapped - r.estimates.front().estimate.stamp);
    if (r.name == "whole") continue;
    ++counted;
    within += r.outcome.found_after_s >= 0.0 && r.outcome.found_after_s <= 10.0 ? 1 : 0;
    if (r.outcome.found_after_s >= 0.0) found.push_back(r.outcome.found_after_s);
    if (r.outcome.lost_after_s >= 0.0) lost.push_back(r.outcome.lost_after_s);
  }
  const auto median = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? "-" : fmt::format("{:.2f} s", values[values.size() / 2]);
  };
  return fmt::format(
      "kidnapped {} times; right again within 10 s: {}; ever: {}, median {}; told lost: {}, median {}\n"
      "false alarms {} in {:.0f} s without an event\n",
      counted, within, found.size(), median(found), lost.size(), median(lost), alarms, before_s);
}

int run_kidnap(const Arguments& arguments) {
  if (arguments.other_log.empty() != arguments.other_reference.empty())
    throw ConfigurationError("--other-log", "needs --other-reference, and that needs it",
                             "give both or none");
  prepare_output_folder(arguments.out);
  const std::vector<Run> runs = Campaign(arguments).run();
  const std::filesystem::path out = arguments.out;
  write_file(out / "events.csv", events_csv(runs));
  write_file(out / "updates.csv", updates_csv(runs));
  std::cout << summary_of(runs);
  return kOk;
}

}  // namespace

void add_kidnap(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("kidnap", "Carry a recorded robot away and see whether it notices");
  auto a = std::make_shared<Arguments>();
  command->add_option("--map", a->map, "Map, as for `cairn localize`")->required();
  command->add_option("--log", a->log, "Recording")->required();
  command->add_option("--reference", a->reference, "Its true trajectory")->required();
  command->add_option("--other-log", a->other_log,
                      "Recording of the same place to go on in (default: --log)");
  command->add_option("--other-reference", a->other_reference, "Its true trajectory");
  command->add_option("--config", a->configs, "Configuration; of several the later win");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  command->add_option("--events", a->events, "Kidnappings; 0: the whole recording without any")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  command->add_option("--before", a->kidnap.before_s, "Seconds driven before")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e5));
  command->add_option("--after", a->kidnap.after_s, "Seconds driven after")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e5));
  command->add_option("--distance", a->kidnap.least_distance_m, "Least distance of the two places, metres")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e5));
  command->add_option("--seed", a->seed, "Of all random numbers")->capture_default_str();
  command->add_option("--jobs", a->jobs, "Runs at a time; changes no result")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_option("--out", a->out, "Folder for events.csv and updates.csv")->required();
  command->footer(
      "The log is cut at one random instant and goes on at another, the odometry as if nothing had "
      "happened.\n"
      "Right: within 1 m and 45 degrees of the reference. Exit code: 0 whatever was measured.");
  command->callback([a, &run] { run = [a] { return run_kidnap(*a); }; });
}

}  // namespace cairn::app
