#include "apps/cairn/what_if_table.hpp"

#include "apps/cairn/localize_run.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/eval/score.hpp"

#include <cmath>
#include <functional>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

double mean_of(const std::vector<Estimate>& estimates, const std::function<double(const Estimate&)>& value) {
  double sum = 0.0;
  for (const Estimate& estimate : estimates) sum += value(estimate);
  return estimates.empty() ? 0.0 : sum / static_cast<double>(estimates.size());
}

struct Row {
  const char* name;
  std::string recorded;
  std::string what_if;
};

template <class Figure>
Row row(const char* name, const std::vector<Estimate>& recorded, const std::vector<Estimate>& what_if,
        Figure figure) {
  return {name, figure(recorded), figure(what_if)};
}

// "mean 4.7, max 31.2", or a dash where the two share no time.
std::string error_cm(const Trajectory& reference, const Trajectory& estimate) {
  try {
    const auto error = score(reference, estimate).ate.position_m;
    return fmt::format("mean {:.1f}, max {:.1f}", 100 * error.mean, 100 * error.max);
  } catch (const InputError&) {
    return "-";
  }
}

}  // namespace

Trajectory trajectory_of(const std::vector<Estimate>& estimates) {
  Trajectory trajectory;
  for (const Estimate& estimate : estimates) trajectory.push_back({estimate.stamp, estimate.T_map_base});
  sort_by_stamp(trajectory);
  return trajectory;
}

std::string what_if_table(const std::vector<Estimate>& recorded, const std::vector<Estimate>& what_if,
                          const std::optional<Trajectory>& reference) {
  using Estimates = std::vector<Estimate>;
  const auto mean = [&](const char* name, const char* format,
                        const std::function<double(const Estimate&)>& value) {
    return row(name, recorded, what_if,
               [&](const Estimates& all) { return fmt::format(fmt::runtime(format), mean_of(all, value)); });
  };
  std::vector<Row> rows{
      {"", "recorded", "what if"},
      row("estimates", recorded, what_if, [](const Estimates& all) { return std::to_string(all.size()); }),
      mean("particles, mean", "{:.0f}", [](const Estimate& e) { return static_cast<double>(e.particles); }),
      mean("quality, mean", "{:.3f}", [](const Estimate& e) { return e.quality; }),
      mean("spread, mean cm", "{:.1f}",
           [](const Estimate& e) { return 100 * std::sqrt(e.covariance(0, 0) + e.covariance(1, 1)); }),
      mean("hypotheses, mean", "{:.2f}", [](const Estimate& e) { return static_cast<double>(e.hypotheses); }),
      row("ends", recorded, what_if,
          [](const Estimates& all) { return judge_end(all).lost ? "lost" : "tracking"; })};
  if (reference) {
    rows.push_back(row("error, cm", recorded, what_if,
                       [&](const Estimates& all) { return error_cm(*reference, trajectory_of(all)); }));
  }
  std::string text;
  for (const Row& r : rows) text += fmt::format("{:<18}{:>24}{:>24}\n", r.name, r.recorded, r.what_if);
  return text + fmt::format("{:<18}{:>48}\n", "apart, cm",
                            error_cm(trajectory_of(recorded), trajectory_of(what_if)));
}

}  // namespace cairn::app
