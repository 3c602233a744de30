#include "cairn/eval/report.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/eval/association.hpp"
#include "cairn/eval/ate.hpp"
#include "cairn/eval/base64.hpp"
#include "cairn/eval/downsample.hpp"
#include "cairn/eval/histogram.hpp"
#include "cairn/eval/page.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxPoints = 4000;
constexpr std::size_t kMaxSnapshots = 400;
constexpr std::size_t kMaxParticles = 120;
constexpr std::size_t kMaxPlaces = 12;

// Digits that no eye could see only make the file longer.
double rounded(double value, double unit) { return std::round(value / unit) * unit; }

json number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

// Six significant digits, for figures that may be of any size (variances).
json significant(double value) {
  if (!std::isfinite(value) || value == 0.0) return value == 0.0 ? json(0) : json(nullptr);
  return rounded(value, std::pow(10.0, std::floor(std::log10(std::abs(value))) - 5.0));
}

class RunWriter {
 public:
  explicit RunWriter(const ReportData& run) : run_(run), start_(start_of(run)) {}

  json write() const;

 private:
  static Time start_of(const ReportData& run) {
    if (!run.trajectory.empty()) return run.trajectory.front().stamp;
    return run.estimates.empty() ? Time{} : run.estimates.front().stamp;
  }

  json time(Time stamp) const { return number(to_seconds(stamp - start_), 3); }
  json path(const Trajectory& trajectory) const;
  json belief() const;
  template <typename Items, typename Value>
  json series(const Items& items, Value value) const;
  json belief_series() const;
  json error_path(const std::vector<PosePair>& pairs, const Ate& ate) const;
  void write_errors(json& out) const;
  json hypotheses() const;
  json particles() const;

  const ReportData& run_;
  Time start_;
};

json RunWriter::path(const Trajectory& trajectory) const {
  json columns = {{"t", json::array()}, {"x", json::array()}, {"y", json::array()}, {"theta", json::array()}};
  for (const std::size_t i : select_evenly(trajectory.size(), kMaxPoints)) {
    const auto& [stamp, pose] = trajectory[i];
    columns["t"].push_back(time(stamp));
    columns["x"].push_back(number(pose.x, 3));
    columns["y"].push_back(number(pose.y, 3));
    columns["theta"].push_back(number(pose.theta, 4));
  }
  return columns;
}

json RunWriter::belief() const {
  json columns;
  for (const char* name : {"t", "x", "y", "var_x", "cov_xy", "var_y", "var_theta", "ess", "particles",
                           "hypotheses", "weight", "quality", "state", "probability"}) {
    columns[name] = json::array();
  }
  for (const std::size_t i : select_evenly(run_.estimates.size(), kMaxPoints)) {
    const Estimate& e = run_.estimates[i];
    columns["t"].push_back(time(e.stamp));
    columns["x"].push_back(number(e.T_map_base.x, 3));
    columns["y"].push_back(number(e.T_map_base.y, 3));
    columns["var_x"].push_back(significant(e.covariance(0, 0)));
    columns["cov_xy"].push_back(significant(e.covariance(0, 1)));
    columns["var_y"].push_back(significant(e.covariance(1, 1)));
    columns["var_theta"].push_back(significant(e.covariance(2, 2)));
    columns["ess"].push_back(number(e.ess, 1));
    columns["particles"].push_back(e.particles);
    columns["hypotheses"].push_back(e.hypotheses);
    columns["weight"].push_back(number(e.weight, 4));
    columns["quality"].push_back(number(e.quality, 4));
    columns["state"].push_back(static_cast<int>(e.judgement.state));
    columns["probability"].push_back(number(e.judgement.probability, 4));
  }
  return columns;
}

// {t, v} of value(item) over item.stamp, with the peaks kept.
template <typename Items, typename Value>
json RunWriter::series(const Items& items, Value value) const {
  std::vector<double> values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(value(item));
  json t = json::array();
  json v = json::array();
  for (const std::size_t i : select_extremes(values, kMaxPoints)) {
    t.push_back(time(items[i].stamp));
    v.push_back(significant(values[i]));
  }
  return {{"t", std::move(t)}, {"v", std::move(v)}};
}

json RunWriter::belief_series() const {
  const auto sigma = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
  const auto of = [&](auto value) { return series(run_.estimates, value); };
  return {
      {"sigma_x_m", of([&](const Estimate& e) { return sigma(e.covariance(0, 0)); })},
      {"sigma_y_m", of([&](const Estimate& e) { return sigma(e.covariance(1, 1)); })},
      {"sigma_position_m",
       of([&](const Estimate& e) { return sigma(e.covariance(0, 0) + e.covariance(1, 1)); })},
      {"sigma_theta_rad", of([&](const Estimate& e) { return sigma(e.covariance(2, 2)); })},
      {"ess", of([](const Estimate& e) { return e.ess; })},
      {"particles", of([](const Estimate& e) { return static_cast<double>(e.particles); })},
      {"quality", of([](const Estimate& e) { return e.quality; })},
      {"probability", of([](const Estimate& e) { return e.judgement.probability; })},
      {"hypotheses", of([](const Estimate& e) { return static_cast<double>(e.hypotheses); })},
      {"weight", of([](const Estimate& e) { return e.weight; })},
  };
}

json RunWriter::error_path(const std::vector<PosePair>& pairs, const Ate& ate) const {
  json columns = {{"t", json::array()},
                  {"x", json::array()},
                  {"y", json::array()},
                  {"position_m", json::array()},
                  {"heading_rad", json::array()}};
  // Evenly: a path of nothing but extremes would look worse than the run was. The chart over time has the
  // peaks.
  for (const std::size_t i : select_evenly(pairs.size(), kMaxPoints)) {
    columns["t"].push_back(time(pairs[i].stamp));
    columns["x"].push_back(number(pairs[i].estimate.x, 3));
    columns["y"].push_back(number(pairs[i].estimate.y, 3));
    columns["position_m"].push_back(number(ate.errors[i].position_m, 4));
    columns["heading_rad"].push_back(number(std::abs(ate.errors[i].heading_rad), 5));
  }
  return columns;
}

void RunWriter::write_errors(json& out) const {
  if (!run_.reference) return;
  out["reference"] = path(*run_.reference);
  const std::vector<PosePair> pairs = associate(*run_.reference, run_.trajectory);
  if (pairs.empty()) return;
  const Ate ate = absolute_trajectory_error(pairs);
  const auto position = [](const PoseError& e) { return e.position_m; };
  const auto heading = [](const PoseError& e) { return std::abs(e.heading_rad); };
  // Bins of a round width must be round in the unit that is shown.
  const auto heading_degrees = [&](const PoseError& e) { return radians_to_degrees(heading(e)); };
  const auto histogram = [&](auto value) {
    std::vector<double> values;
    for (const PoseError& error : ate.errors) values.push_back(value(error));
    const Histogram made = make_histogram(values);
    return json{{"width", made.width}, {"counts", made.counts}, {"beyond", made.beyond}};
  };
  out["errors"] = error_path(pairs, ate);
  out["errors"]["p95_m"] = significant(ate.position_m.p95);
  out["series"]["position_error_m"] = series(ate.errors, position);
  out["series"]["heading_error_rad"] = series(ate.errors, heading);
  out["histograms"] = {{"position", histogram(position)}, {"heading", histogram(heading_degrees)}};
}

json RunWriter::hypotheses() const {
  json t = json::array();
  json places = json::array();
  for (const std::size_t i : select_evenly(run_.hypotheses.size(), kMaxPoints)) {
    const HypothesisSnapshot& snapshot = run_.hypotheses[i];
    t.push_back(time(snapshot.stamp));
    json flat = json::array();
    for (const std::size_t k : select_evenly(snapshot.hypotheses.size(), kMaxPlaces)) {
      const Hypothesis& h = snapshot.hypotheses[k];
      for (const double value : {h.T_map_base.x, h.T_map_base.y}) flat.push_back(number(value, 3));
      for (const double value : {h.covariance(0, 0), h.covariance(0, 1), h.covariance(1, 1)})
        flat.push_back(significant(value));
      flat.push_back(number(h.weight, 3));
      flat.push_back(number(h.age_s, 1));
    }
    places.push_back(std::move(flat));
  }
  return {{"t", std::move(t)}, {"places", std::move(places)}};
}

json RunWriter::particles() const {
  json t = json::array();
  json clouds = json::array();
  for (const std::size_t i : select_evenly(run_.particles.size(), kMaxSnapshots)) {
    const ParticleSnapshot& snapshot = run_.particles[i];
    t.push_back(time(snapshot.stamp));
    json cloud = json::array();
    for (const std::size_t k : select_evenly(snapshot.particles.size(), kMaxParticles)) {
      const Pose2& p = snapshot.particles[k];
      for (const double value : {p.x, p.y, p.theta}) cloud.push_back(std::llround(value * 1000.0));
    }
    clouds.push_back(std::move(cloud));
  }
  return {{"t", std::move(t)}, {"mm", std::move(clouds)}};
}

json map_of(const ReportMap& map) {
  const GridGeometry& g = map.geometry;
  return {{"png", to_base64(map.png)},
          {"width", g.width},
          {"height", g.height},
          {"resolution_m", g.resolution_m},
          {"origin", {g.T_map_grid.x, g.T_map_grid.y, g.T_map_grid.theta}}};
}

json RunWriter::write() const {
  json out;
  out["metrics"] = json::parse(run_.metrics, nullptr, /*allow_exceptions=*/false);
  if (!out["metrics"].is_object()) {
    throw InputError("metrics.json", "is not a JSON object",
                     "write the run again with `cairn localize --out`");
  }
  out["configuration"] = run_.configuration;
  out["path"] = path(run_.trajectory);
  out["belief"] = belief();
  out["series"] = belief_series();
  out["hypotheses"] = hypotheses();
  out["particles"] = particles();
  write_errors(out);
  if (run_.map) out["map"] = map_of(*run_.map);
  return out;
}

}  // namespace

std::string render_report(std::string_view page, const ReportData& run) {
  return fill_page(page, RunWriter(run).write().dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace cairn
