#include "apps/cairn/localize_metrics.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/eval/score.hpp"
#include "cairn/localization/monitor.hpp"

#include <algorithm>
#include <numeric>

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

namespace cairn::app {
namespace {

using nlohmann::json;

double span_s(const Log& log) {
  return log.events.empty() ? 0.0 : to_seconds(log.events.back().stamp - log.events.front().stamp);
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

json log_json(const std::string& path, const Log& log, const std::vector<OutcomeCounts>& outcomes) {
  json streams = json::array();
  for (std::size_t i = 0; i < log.streams.size(); ++i) {
    const std::int64_t messages = std::accumulate(outcomes[i].begin(), outcomes[i].end(), std::int64_t{0});
    streams.push_back(
        {{"name", log.streams[i].name}, {"kind", name_of(log.streams[i].kind)}, {"messages", messages}});
  }
  return {{"path", path}, {"format", log.format}, {"span_s", span_s(log)}, {"streams", streams}};
}

json outcomes_json(const Log& log, const std::vector<OutcomeCounts>& outcomes) {
  json all = json::object();
  for (std::size_t i = 0; i < log.streams.size(); ++i) {
    json& stream = all[log.streams[i].name] = json::object();
    for (std::size_t k = 0; k < kOutcomeCount; ++k) {
      if (outcomes[i][k] != 0) stream[to_string(static_cast<Outcome>(k))] = outcomes[i][k];
    }
  }
  return all;
}

json drop_rates_json(const Log& log, const std::vector<OutcomeCounts>& outcomes) {
  json rates = json::object();
  for (std::size_t i = 0; i < log.streams.size(); ++i) rates[log.streams[i].name] = drop_rate(outcomes[i]);
  return rates;
}

json accuracy_json(const Score& score) {
  const Summary& position = score.ate.position_m;
  return {{"matched", position.count},
          {"reference_samples", score.reference_samples},
          {"ate_mean_m", position.mean},
          {"ate_std_m", position.standard_deviation},
          {"ate_rmse_m", position.rms},
          {"ate_median_m", position.median},
          {"ate_p95_m", position.p95},
          {"ate_max_m", position.max},
          {"heading_mean_rad", score.ate.heading_rad.mean},
          {"heading_max_rad", score.ate.heading_rad.max},
          {"lost", score.lost.lost}};
}

json timings_json(const RunContext& context, const Log& log, const LocalizeResult& result) {
  const double total_s = context.read_s + result.prepare_s + result.run_s;
  const auto updates = static_cast<double>(std::max<std::int64_t>(result.updates, 1));
  return {{"read_s", context.read_s},
          {"prepare_s", result.prepare_s},
          {"run_s", result.run_s},
          {"total_s", total_s},
          {"realtime_factor", total_s > 0.0 ? span_s(log) / total_s : 0.0},
          {"update_mean_ms", 1e3 * result.run_s / updates}};
}

json warnings_json(std::initializer_list<const Diagnostics*> all) {
  json warnings = json::object();
  for (const Diagnostics* diagnostics : all) {
    for (const auto& [kind, count] : diagnostics->counts()) warnings[kind] = warnings.value(kind, 0L) + count;
  }
  return warnings;
}

// How the localizer judged itself: share of the scans per state, and how often it became lost.
json monitor_json(const std::vector<Estimate>& estimates) {
  json shares = json::object();
  int times_lost = 0;
  TrackingState before = TrackingState::kTracking;
  for (const Estimate& e : estimates) {
    const TrackingState state = e.judgement.state;
    const char* name = to_string(state);
    shares[name] = shares.value(name, 0.0) + 1.0 / static_cast<double>(estimates.size());
    times_lost += state == TrackingState::kLost && before != TrackingState::kLost ? 1 : 0;
    before = state;
  }
  json monitor = {{"shares", shares}, {"times_lost", times_lost}};
  if (estimates.empty()) return monitor;
  monitor["state"] = to_string(before);
  monitor["probability"] = estimates.back().judgement.probability;
  monitor["reason"] = explain(estimates.back().judgement);
  return monitor;
}

std::string text_of(const json& metrics) {
  std::string text;
  if (metrics.contains("accuracy")) {
    const json& a = metrics["accuracy"];
    text += fmt::format(
        "error     mean {:.1f} cm, median {:.1f}, 95 % {:.1f}, max {:.1f} cm; heading mean {:.2f} deg\n",
        100 * a["ate_mean_m"].get<double>(), 100 * a["ate_median_m"].get<double>(),
        100 * a["ate_p95_m"].get<double>(), 100 * a["ate_max_m"].get<double>(),
        radians_to_degrees(a["heading_mean_rad"].get<double>()));
  }
  const json& t = metrics["timings"];
  text += fmt::format("belief    {}, {} updates", metrics["verdict"].get<std::string>(),
                      metrics["updates"].get<std::int64_t>());
  if (const json& end = metrics["monitor"]; end.contains("state"))
    text += fmt::format("; at the end {}, right with a probability of {:.0f} %",
                        end["state"].get<std::string>(), 100.0 * end["probability"].get<double>());
  text += '\n';
  text += fmt::format("time      {:.2f} s for {:.0f} s of log ({:.0f} times real time, reading included)\n",
                      t["total_s"].get<double>(), metrics["log"]["span_s"].get<double>(),
                      t["realtime_factor"].get<double>());
  for (const auto& [kind, count] : metrics["warnings"].items()) {
    text += fmt::format("warning   {}: {}\n", kind, count.get<std::int64_t>());
  }
  return text;
}

std::string lost_by_reference(const Score& score) {
  return fmt::format("{:.0f} % of the poses are more than 1 m or 45 degrees off the reference{}",
                     100 * score.lost.bad_share, score.lost.ends_lost ? ", the last ones too" : "");
}

std::string near_reference(const Score& score) {
  return fmt::format("{:.0f} % of the poses lie within 1 m and 45 degrees of the reference",
                     100 * (1.0 - score.lost.bad_share));
}

// An interrupted run may end before its reference begins.
bool any_inside(const Trajectory& reference, const Trajectory& estimate) {
  return !estimate.empty() && std::any_of(reference.begin(), reference.end(), [&](const StampedPose& p) {
    return p.stamp >= estimate.front().stamp && p.stamp <= estimate.back().stamp;
  });
}

Trajectory trajectory_of(const std::vector<Estimate>& estimates) {
  Trajectory trajectory;
  for (const Estimate& estimate : estimates) trajectory.push_back({estimate.stamp, estimate.T_map_base});
  sort_by_stamp(trajectory);
  return trajectory;
}

}  // namespace

RunSummary summarize_run(const RunContext& context, const Log& log, const OccupancyGrid& map,
                         const LocalizerOptions& options, const std::optional<Trajectory>& reference,
                         const Diagnostics& input_diagnostics, const LocalizeResult& result) {
  RunSummary summary;
  const EndVerdict verdict = judge_end(result.estimates);
  summary.lost = verdict.lost;
  summary.reason = verdict.reason;
  json& m = summary.metrics;
  m = {{"cairn_version", CAIRN_VERSION},
       {"recipe", options.recipe},
       {"seed", context.seed},
       {"threads", context.threads},
       {"live", context.live},
       {"interrupted", result.interrupted},
       {"log", log_json(context.log_path, log, result.outcomes)},
       {"map",
        {{"path", context.map_path},
         {"width", map.geometry().width},
         {"height", map.geometry().height},
         {"resolution_m", map.geometry().resolution_m}}},
       {"outcomes", outcomes_json(log, result.outcomes)},
       {"drop_rates", drop_rates_json(log, result.outcomes)},
       {"updates", result.updates},
       {"monitor", monitor_json(result.estimates)},
       {"timings", timings_json(context, log, result)},
       {"peak_memory_bytes", peak_memory_bytes()},
       {"warnings", warnings_json({&log.diagnostics, &input_diagnostics, &result.diagnostics})}};
  const Trajectory trajectory = trajectory_of(result.estimates);
  if (reference && !any_inside(*reference, trajectory)) {
    m["warnings"]["no reference pose inside the estimates: no accuracy"] = 1;
  } else if (reference) {
    const Score measured = score(*reference, trajectory);
    m["accuracy"] = accuracy_json(measured);
    summary.lost = measured.lost.lost;
    summary.reason = summary.lost ? lost_by_reference(measured) : near_reference(measured);
  }
  m["verdict"] = summary.lost ? "lost" : "tracking";
  m["verdict_reason"] = summary.reason;
  summary.text = text_of(m);
  return summary;
}

}  // namespace cairn::app
