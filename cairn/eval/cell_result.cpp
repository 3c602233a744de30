#include "cairn/eval/cell_result.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/eval/downsample.hpp"

#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTracePoints = 400;
constexpr double kSettled_s = 10.0;

Json finite_only(const std::map<std::string, double>& metrics) {
  Json json = Json::object();
  for (const auto& [name, value] : metrics) {
    if (std::isfinite(value)) json[name] = value;
  }
  return json;
}

Json to_json(const ErrorTrace& trace) {
  return {{"t_s", trace.t_s}, {"x_m", trace.x_m}, {"y_m", trace.y_m}, {"error_m", trace.error_m}};
}

ErrorTrace trace_from(const Json& json) {
  ErrorTrace trace;
  json.at("t_s").get_to(trace.t_s);
  json.at("x_m").get_to(trace.x_m);
  json.at("y_m").get_to(trace.y_m);
  json.at("error_m").get_to(trace.error_m);
  return trace;
}

bool same_sizes(const ErrorTrace& trace) {
  const std::size_t n = trace.t_s.size();
  return trace.x_m.size() == n && trace.y_m.size() == n && trace.error_m.size() == n;
}

// Seconds from the first error to the beginning of the first good stretch that lasts.
std::optional<double> converged_after_s(const std::vector<PoseError>& errors, const LostOptions& limits) {
  std::optional<Time> good_since;
  for (const PoseError& e : errors) {
    const bool good = e.position_m <= limits.position_m && std::abs(e.heading_rad) <= limits.heading_rad;
    if (!good) {
      good_since.reset();
    } else if (!good_since) {
      good_since = e.stamp;
    }
    if (good_since && to_seconds(e.stamp - *good_since) >= kSettled_s) break;
  }
  if (!good_since) return std::nullopt;
  return to_seconds(*good_since - errors.front().stamp);
}

ErrorTrace thin_out(const std::vector<PoseError>& errors, const Trajectory& reference) {
  ErrorTrace trace;
  for (const std::size_t i : select_evenly(errors.size(), kTracePoints)) {
    const auto pose = pose_at(reference, errors[i].stamp);
    if (!pose) continue;
    trace.t_s.push_back(to_seconds(errors[i].stamp - errors.front().stamp));
    trace.x_m.push_back(pose->x);
    trace.y_m.push_back(pose->y);
    trace.error_m.push_back(errors[i].position_m);
  }
  return trace;
}

}  // namespace

std::string to_json(const CellResult& result) {
  Json json = {{"id", result.id},
               {"input", result.input},
               {"recipe", result.recipe},
               {"parameters", result.parameters},
               {"variant", result.variant},
               {"seed", result.seed},
               {"program", result.program},
               {"command", result.command},
               {"metrics", finite_only(result.metrics)},
               {"trace", to_json(result.trace)}};
  if (!result.distributions.empty()) json["distributions"] = result.distributions;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

CellResult cell_result_from_json(std::string_view text, const std::string& where) {
  try {
    const Json json = Json::parse(text);
    CellResult result;
    json.at("id").get_to(result.id);
    json.at("input").get_to(result.input);
    json.at("recipe").get_to(result.recipe);
    json.at("parameters").get_to(result.parameters);
    json.at("variant").get_to(result.variant);
    json.at("seed").get_to(result.seed);
    json.at("program").get_to(result.program);
    json.at("command").get_to(result.command);
    json.at("metrics").get_to(result.metrics);
    result.trace = trace_from(json.at("trace"));
    if (json.contains("distributions")) json.at("distributions").get_to(result.distributions);
    if (same_sizes(result.trace)) return result;
  } catch (const Json::exception&) {
    // Refused below, in one sentence.
  }
  throw InputError(where, "is not the result of a cell", "remove it: the cell is then run again");
}

void add_accuracy(const Score& score, const Trajectory& reference, CellResult& result) {
  const Summary& position = score.ate.position_m;
  auto& metrics = result.metrics;
  metrics["ate_mean_m"] = position.mean;
  metrics["ate_rmse_m"] = position.rms;
  metrics["ate_median_m"] = position.median;
  metrics["ate_p95_m"] = position.p95;
  metrics["ate_max_m"] = position.max;
  if (!score.ate.errors.empty()) metrics["final_error_m"] = score.ate.errors.back().position_m;
  metrics["heading_mean_rad"] = score.ate.heading_rad.mean;
  metrics["coverage"] = score.coverage;
  metrics["bad_share"] = score.lost.bad_share;
  metrics["lost"] = score.lost.lost ? 1.0 : 0.0;
  if (score.rpe.pairs > 0) {
    metrics["rpe_translation_m"] = score.rpe.translation_rms_m;
    metrics["rpe_rotation_rad"] = score.rpe.rotation_rms_rad;
  }
  if (const auto converged = converged_after_s(score.ate.errors, {})) metrics["converged_s"] = *converged;
  result.trace = thin_out(score.ate.errors, reference);
}

}  // namespace cairn
