#include "apps/cairn/campaign_cell.hpp"

#include "apps/cairn/fingerprint.hpp"
#include "apps/cairn/log_noise.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/world_file.hpp"

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Names as the user wrote them rather than absolute paths: the same on another machine.
std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

// Whether the outcome of that name is of the kind.
bool is_outcome(const std::string& name, bool (*is_kind)(Outcome)) {
  for (std::size_t k = 0; k < kOutcomeCount; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    if (name == to_string(outcome)) return is_kind(outcome);
  }
  return false;
}

void add_outcomes(const json& metrics, CellResult& result) {
  for (const json& stream : metrics["log"]["streams"]) {
    if (stream["kind"] == "odometry") continue;
    const auto name = stream["name"].get<std::string>();
    double total = 0.0, used = 0.0, dropped = 0.0;
    for (const auto& [outcome, count] : metrics["outcomes"][name].items()) {
      const auto n = count.get<double>();
      total += n;
      if (is_outcome(outcome, is_use)) used += n;
      if (is_outcome(outcome, is_drop)) dropped += n;
    }
    if (total <= 0.0) continue;
    result.metrics["drop_rate." + name] = dropped / total;
    result.metrics["unused_rate." + name] = 1.0 - used / total;
  }
}

double mean_particles(const std::vector<Estimate>& estimates) {
  double sum = 0.0;
  for (const Estimate& e : estimates) sum += e.particles;
  return estimates.empty() ? 0.0 : sum / static_cast<double>(estimates.size());
}

void add_costs(const json& metrics, const JobEnd& end, CellResult& result) {
  result.metrics["cpu_s"] = end.cpu_s;
  result.metrics["wall_s"] = end.wall_s;
  result.metrics["run_s"] = metrics["timings"]["run_s"].get<double>();
  result.metrics["peak_memory_bytes"] = static_cast<double>(end.peak_memory_bytes);
  result.metrics["updates"] = metrics["updates"].get<double>();
}

}  // namespace

CellRecording recording_of(const Campaign& campaign, const CampaignCell& cell, const fs::path& logs) {
  const CampaignInput& input = campaign.inputs[cell.input];
  const bool sensors = campaign.measures_sensors();
  if (input.world.empty() || (sensors && cell.variant == kVariantReal))
    return {input.log, input.map, input.reference, {}, {}, {}};
  CellRecording recording;
  const std::string seed = input.world_seed == "each" ? std::to_string(cell.seed) : input.world_seed;
  recording.simulate = {"simulate", input.world, "--seed", seed};
  if (input.duration_s > 0.0) {
    recording.simulate.insert(recording.simulate.end(), {"--duration", fmt::format("{}", input.duration_s)});
  }
  for (const std::string& setting : split_words(input.world_set)) {
    recording.simulate.insert(recording.simulate.end(), {"--set", setting});
  }
  Fingerprint fingerprint;
  for (const std::string& word : recording.simulate)
    fingerprint.add(word == input.world ? file_name(word) : word);
  if (!is_built_in_world(input.world)) {
    for (const std::string& file : files_of_world(input.world)) fingerprint.add_file(file);
  }
  recording.id = fingerprint.text();
  const fs::path folder = logs / recording.id;
  recording.file = sensors ? kSimulatedSensors : kSimulatedLog;
  recording.log = (folder / recording.file).string();
  recording.map = sensors ? input.map : (folder / kSimulatedMap).string();
  recording.reference = (folder / kSimulatedTruth).string();
  return recording;
}

namespace {

std::vector<std::string> noise_arguments(const CampaignInput& input, const CampaignCell& cell,
                                         const CellRecording& recording) {
  std::vector<std::string> words{"log",     "noise",       "--log",       recording.log,
                                 "--map",   recording.map, "--reference", recording.reference,
                                 "--world", input.world,   "--max-gap-s", fmt::format("{}", input.max_gap_s)};
  const auto add = [&words](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  if (cell.variant == kVariantSimulated)
    return words;  // has one laser and one odometry, and tells its mounts
  add("--stream", input.stream);
  add("--odometry", input.odometry);
  add("--trajectory-frame", input.trajectory_frame);
  return words;
}

}  // namespace

std::vector<std::string> cell_arguments(const Campaign& campaign, const CampaignCell& cell,
                                        const CellRecording& recording) {
  const CampaignInput& input = campaign.inputs[cell.input];
  if (campaign.measures_sensors()) return noise_arguments(input, cell, recording);
  const CellSettings settings = settings_of(campaign, cell);
  std::vector<std::string> words{"localize", "--map", recording.map, "--log", recording.log};
  const auto add = [&words](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  if (!recording.reference.empty()) add({"--reference", recording.reference});
  if (!settings.config.empty()) add({"--config", settings.config});
  for (const std::string& setting : settings.set) add({"--set", setting});
  if (input.start == "global") {
    add({"--global"});
  } else {
    add({"--init", input.start, "--init-error", input.start_error});
  }
  if (input.live) add({"--live"});
  add({"--seed", std::to_string(cell.seed), "--threads", "1"});
  return words;
}

std::string cell_id(const Campaign& campaign, const CampaignCell& cell, const CellRecording& recording) {
  const CampaignInput& input = campaign.inputs[cell.input];
  const CellSettings settings = settings_of(campaign, cell);
  Fingerprint fingerprint;
  for (const std::string& name :
       {input.name, cell.recipe, campaign.parameters[cell.parameters].name, cell.variant,
        std::to_string(cell.seed), input.start, input.start_error, std::string(input.live ? "live" : ""),
        fmt::format("{}", campaign.rpe_delta_m), recording.id}) {
    fingerprint.add(name);
  }
  for (const std::string& setting : settings.set) fingerprint.add(setting);
  fingerprint.add_file(settings.config);
  if (campaign.measures_sensors()) {
    for (const std::string& word : {campaign.task, input.stream, input.odometry, input.trajectory_frame,
                                    fmt::format("{}", input.max_gap_s)}) {
      fingerprint.add(word);
    }
    fingerprint.add_file(input.map);
    if (!is_built_in_world(input.world)) fingerprint.add_file(input.world);
  }
  if (!recording.simulate.empty()) return fingerprint.text();
  for (const std::string& path : {recording.log, recording.map, recording.reference}) {
    fingerprint.add(file_name(path));
    fingerprint.add_file(path);
  }
  return fingerprint.text();
}

namespace {

CellResult read_noise(const Campaign& campaign, const CampaignCell& cell, const fs::path& run,
                      const JobEnd& end) {
  const json noise = json::parse(read_file(run / kNoiseFile));
  CellResult result;
  result.input = campaign.inputs[cell.input].name;
  result.parameters = campaign.parameters[cell.parameters].name;
  result.variant = cell.variant;
  result.seed = cell.seed;
  noise.at("metrics").get_to(result.metrics);
  noise.at("distributions").get_to(result.distributions);
  result.metrics["cpu_s"] = end.cpu_s;
  return result;
}

}  // namespace

CellResult read_cell(const Campaign& campaign, const CampaignCell& cell, const fs::path& run,
                     const JobEnd& end) {
  if (campaign.measures_sensors()) return read_noise(campaign, cell, run, end);
  const RunData data = read_run(run);
  CellResult result;
  result.input = campaign.inputs[cell.input].name;
  result.recipe = data.metrics.value("recipe", cell.recipe);
  result.parameters = campaign.parameters[cell.parameters].name;
  result.variant = cell.variant;
  result.seed = cell.seed;
  result.metrics["lost"] = data.metrics.value("verdict", "lost") == "lost" ? 1.0 : 0.0;
  if (data.reference && data.metrics.contains("accuracy")) {
    ScoreOptions options;
    options.rpe_delta_m = campaign.rpe_delta_m;
    add_accuracy(score(*data.reference, data.trajectory, options), *data.reference, result);
  }
  add_outcomes(data.metrics, result);
  add_costs(data.metrics, end, result);
  result.metrics["particles_mean"] = mean_particles(data.estimates);
  return result;
}

}  // namespace cairn::app
