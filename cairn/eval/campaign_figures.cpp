#include "cairn/eval/campaign_figures.hpp"

#include "cairn/eval/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace cairn {
namespace {

// The brightest colour of an error map: the first that hardly an error exceeds.
constexpr std::array kBright_m = {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};
constexpr double kDarker = 0.99;  // share of the errors
constexpr double kLost_m = 1.0;
constexpr double kShownQuantiles = 0.03;  // of the distributions: the tails would press the rest together
constexpr int kTimeSteps = 100;
constexpr std::size_t kCurvePoints = 200;
constexpr std::size_t kMapPoints = 6000;
constexpr int kBins = 12;
constexpr double kLeastError_m = 1e-3;  // of the logarithmic axes

std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  return name;
}

template <class Key>
std::vector<std::string> names_of(const CampaignReport& report, Key key) {
  std::vector<std::string> names;
  for (const CellResult& r : report.results) {
    if (std::find(names.begin(), names.end(), key(r)) == names.end()) names.push_back(key(r));
  }
  return names;
}

std::vector<const ErrorTrace*> traces_of(const CampaignReport& report, const std::string& input,
                                         const std::string& variant) {
  std::vector<const ErrorTrace*> traces;
  for (const CellResult& r : report.results) {
    if (r.input == input && r.variant == variant && !r.trace.t_s.empty()) traces.push_back(&r.trace);
  }
  return traces;
}

// @param points  with their errors, the smallest first
double bright_for(const std::vector<std::pair<double, SvgPoint>>& points) {
  if (points.empty()) return kBright_m.back();
  const auto place = static_cast<std::size_t>(kDarker * static_cast<double>(points.size() - 1));
  const auto bright = std::lower_bound(kBright_m.begin(), kBright_m.end(), points[place].first);
  return bright == kBright_m.end() ? kBright_m.back() : *bright;
}

SvgPlot error_map(const CampaignReport& report, const std::string& input) {
  const auto traces = traces_of(report, input, report.baseline);
  std::size_t total = 0;
  for (const ErrorTrace* trace : traces) total += trace->t_s.size();
  const std::size_t step = total / kMapPoints + 1;
  std::vector<std::pair<double, SvgPoint>> points;
  for (const ErrorTrace* trace : traces) {
    for (std::size_t i = 0; i < trace->t_s.size(); i += step)
      points.push_back({trace->error_m[i], {trace->x_m[i], trace->y_m[i]}});
  }
  // The large errors last, on top of the others.
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const double bright_m = bright_for(points);
  std::ostringstream title;
  title << report.baseline << ": error, dark 0 to bright " << bright_m << " m";
  SvgPlot plot{title.str(), {"x [m]"}, {"y [m]"}, true, {{"", {}, true, {}}}};
  for (const auto& [error, point] : points) {
    plot.series[0].points.push_back(point);
    plot.series[0].shades.push_back(std::min(1.0, error / bright_m));
  }
  return plot;
}

SvgPlot error_distribution(const CampaignReport& report, const std::string& input,
                           const std::vector<std::string>& variants) {
  SvgPlot plot{input + ": share of poses with less error", {"error [m]", true}, {"share"}, false, {}};
  for (const std::string& variant : variants) {
    std::vector<double> errors;
    for (const ErrorTrace* trace : traces_of(report, input, variant))
      errors.insert(errors.end(), trace->error_m.begin(), trace->error_m.end());
    std::sort(errors.begin(), errors.end());
    SvgSeries& series = plot.series.emplace_back();
    series.name = variant;
    const std::size_t step = errors.size() / kCurvePoints + 1;
    for (std::size_t i = 0; i < errors.size(); i += step) {
      series.points.push_back({std::max(kLeastError_m, errors[i]),
                               static_cast<double>(i + 1) / static_cast<double>(errors.size())});
    }
  }
  return plot;
}

double error_at(const ErrorTrace& trace, double t) {
  const auto after = std::upper_bound(trace.t_s.begin(), trace.t_s.end(), t);
  const auto index = after == trace.t_s.begin() ? 0 : after - trace.t_s.begin() - 1;
  return trace.error_m[static_cast<std::size_t>(index)];
}

SvgPlot survival(const CampaignReport& report, const std::string& input,
                 const std::vector<std::string>& variants) {
  SvgPlot plot{input + ": runs within 1 m", {"time [s]"}, {"share of runs"}, false, {}};
  for (const std::string& variant : variants) {
    const auto traces = traces_of(report, input, variant);
    double end = 0.0;
    for (const ErrorTrace* trace : traces) end = std::max(end, trace->t_s.back());
    SvgSeries series{variant, {}, false, {}};
    for (int i = 0; i <= kTimeSteps && !traces.empty(); ++i) {
      const double t = end * i / kTimeSteps;
      double good = 0.0;
      for (const ErrorTrace* trace : traces) good += error_at(*trace, t) < kLost_m ? 1.0 : 0.0;
      series.points.push_back({t, good / static_cast<double>(traces.size())});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// Of all runs that tell it, the smallest first.
std::vector<double> sorted_metric(const CampaignReport& report, const std::string& input,
                                  const std::string& variant, const char* metric) {
  std::vector<double> values;
  for (const CellResult& r : report.results) {
    const auto value = r.metrics.find(metric);
    if (r.input == input && (variant.empty() || r.variant == variant) && value != r.metrics.end() &&
        std::isfinite(value->second))
      values.push_back(value->second);
  }
  std::sort(values.begin(), values.end());
  return values;
}

// The bins are as wide as each other by their ratio, and the same for all variants.
SvgPlot final_errors(const CampaignReport& report, const std::string& input,
                     const std::vector<std::string>& variants) {
  SvgPlot plot{
      input + ": histogram of the errors at the end", {"error [m]", true}, {"share of runs"}, false, {}};
  const auto all = sorted_metric(report, input, "", "final_error_m");
  if (all.empty()) return plot;
  const double least = std::log(std::max(kLeastError_m, all.front()));
  const double width = std::max(1e-3, std::log(std::max(kLeastError_m, all.back())) - least) / kBins;
  for (const std::string& variant : variants) {
    const auto errors = sorted_metric(report, input, variant, "final_error_m");
    std::array<double, kBins> shares{};
    for (const double error : errors) {
      const int bin = static_cast<int>((std::log(std::max(kLeastError_m, error)) - least) / width);
      shares[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))] +=
          1.0 / static_cast<double>(errors.size());
    }
    SvgSeries& series = plot.series.emplace_back();
    series.name = variant;
    for (std::size_t i = 0; i < kBins; ++i) {
      const double bin = static_cast<double>(i);
      series.points.push_back({std::exp(least + width * bin), shares[i]});
      series.points.push_back({std::exp(least + width * (bin + 1.0)), shares[i]});
    }
  }
  return plot;
}

std::size_t runs_of(const CampaignReport& report, const std::string& input, const std::string& variant) {
  return static_cast<std::size_t>(
      std::count_if(report.results.begin(), report.results.end(),
                    [&](const CellResult& r) { return r.input == input && r.variant == variant; }));
}

// Runs that never converge leave the curve below one. @pre some have
SvgPlot convergence(const CampaignReport& report, const std::string& input,
                    const std::vector<std::string>& variants) {
  SvgPlot plot{input + ": runs that have converged", {"time [s]"}, {"share of runs"}, false, {}};
  const double end = sorted_metric(report, input, "", "converged_s").back();
  for (const std::string& variant : variants) {
    SvgSeries& series = plot.series.emplace_back();
    series.name = variant;
    series.points.push_back({0.0, 0.0});
    for (const double t : sorted_metric(report, input, variant, "converged_s")) {
      const double before = series.points.back().y;
      series.points.push_back({t, before});
      series.points.push_back({t, before + 1.0 / static_cast<double>(runs_of(report, input, variant))});
    }
    series.points.push_back({end, series.points.back().y});
  }
  return plot;
}

// From a known start, runs have converged from the beginning.
bool begins_unknown(const CampaignReport& report, const std::string& input) {
  const auto times = sorted_metric(report, input, "", "converged_s");
  return !times.empty() && times.back() > 0.0;
}

// A line for each recipe, its sets of parameters in their order.
SvgPlot cost_plot(const CampaignReport& report, const std::string& input, const char* metric,
                  const char* label) {
  SvgPlot plot{input, {"computing time of a run [s]", true}, {label, true}, false, {}};
  std::map<std::string, std::string> recipe_of;
  for (const CellResult& r : report.results) recipe_of[r.variant] = r.recipe;
  for (const CampaignGroup& group : report.summary.groups) {
    const auto error = group.median.find(metric), cost = group.median.find("cpu_s");
    if (group.input != input || error == group.median.end() || cost == group.median.end()) continue;
    const std::string& recipe = recipe_of[group.variant];
    const auto known = std::find_if(plot.series.begin(), plot.series.end(),
                                    [&](const SvgSeries& s) { return s.name == recipe; });
    SvgSeries& series =
        known == plot.series.end() ? plot.series.emplace_back(SvgSeries{recipe, {}, false, {}}) : *known;
    series.points.push_back({cost->second, error->second});
  }
  return plot;
}

bool has_costs(const CampaignReport& report) {
  const auto parameters = names_of(report, [](const CellResult& r) { return r.parameters; });
  const auto recipes = names_of(report, [](const CellResult& r) { return r.recipe; });
  return parameters.size() > 2 && recipes.size() > 1;
}

std::vector<CampaignFigure> localization_figures(const CampaignReport& report) {
  std::vector<CampaignFigure> figures;
  const auto variants = names_of(report, [](const CellResult& r) { return r.variant; });
  const bool costs = has_costs(report);
  for (const std::string& input : names_of(report, [](const CellResult& r) { return r.input; })) {
    if (costs) {
      const SvgPlot panels[] = {
          cost_plot(report, input, "ate_mean_m", "median over the runs of the mean error [m]"),
          cost_plot(report, input, "ate_max_m", "median over the runs of the largest error [m]")};
      figures.push_back({"cost-" + file_name(input), render_svg(panels, 2)});
      continue;
    }
    std::vector<SvgPlot> panels{error_map(report, input), error_distribution(report, input, variants),
                                survival(report, input, variants), final_errors(report, input, variants)};
    if (begins_unknown(report, input)) panels.push_back(convergence(report, input, variants));
    figures.push_back({file_name(input), render_svg(panels, 3)});
  }
  return figures;
}

SvgSeries quantile_curve(const std::string& name, const std::vector<double>& quantiles) {
  SvgSeries series{name, {}, false, {}};
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(quantiles.size() - 1);
    if (share >= kShownQuantiles && share <= 1.0 - kShownQuantiles)
      series.points.push_back({quantiles[i], share});
  }
  return series;
}

std::vector<CampaignFigure> sensor_figures(const CampaignReport& report) {
  std::vector<CampaignFigure> figures;
  for (const std::string& input : names_of(report, [](const CellResult& r) { return r.input; })) {
    std::set<std::string> names;
    for (const CellResult& r : report.results) {
      for (const auto& [name, unused] : r.distributions) {
        if (r.input == input) names.insert(name);
      }
    }
    std::vector<SvgPlot> panels;
    for (const std::string& name : names) {
      SvgPlot& plot = panels.emplace_back();
      plot.title = input;
      plot.title.append(": ").append(name);
      plot.x.label = name == "heading" || name == "turn" ? "error [rad]" : "error [m]";
      plot.y.label = "share below";
      for (const char* variant : {kVariantReal, kVariantSimulated})
        plot.series.push_back(quantile_curve(variant, mean_quantiles(report, input, variant, name)));
    }
    figures.push_back({file_name(input), render_svg(panels, 3)});
  }
  return figures;
}

}  // namespace

std::vector<double> mean_quantiles(const CampaignReport& report, const std::string& input,
                                   const std::string& variant, const std::string& distribution) {
  std::vector<double> sum;
  double count = 0.0;
  for (const CellResult& r : report.results) {
    const auto found = r.distributions.find(distribution);
    if (r.input != input || r.variant != variant || found == r.distributions.end()) continue;
    if (sum.empty()) sum.resize(found->second.size(), 0.0);
    if (found->second.size() != sum.size()) continue;  // of another build
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += found->second[i];
    count += 1.0;
  }
  for (double& value : sum) value /= count;
  return sum;
}

double distribution_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

std::vector<CampaignFigure> campaign_figures(const CampaignReport& report) {
  return report.sensors ? sensor_figures(report) : localization_figures(report);
}

}  // namespace cairn
