#include "cairn/eval/sensor_tables.hpp"

#include "cairn/eval/campaign_figures.hpp"
#include "cairn/eval/metric_style.hpp"

#include <cmath>
#include <set>

namespace cairn {
namespace {

const CampaignGroup* group_of(const CampaignReport& report, const std::string& input, const char* variant) {
  for (const CampaignGroup& group : report.summary.groups) {
    if (group.input == input && group.variant == variant) return &group;
  }
  return nullptr;
}

std::string mean_of(const CampaignGroup* group, const std::string& metric) {
  if (group == nullptr || group->metrics.count(metric) == 0) return "-";
  const MetricStyle style = style_of(metric);
  std::string mean = format_metric(style, group->metrics.at(metric).mean);
  if (group->cells < 2) return mean;
  return mean + " (" + format_metric(style, group->smallest.at(metric)) + " to " +
         format_metric(style, group->largest.at(metric)) + ")";
}

std::set<std::string> metrics_of(const CampaignGroup* real, const CampaignGroup* simulated) {
  std::set<std::string> names;
  for (const CampaignGroup* group : {real, simulated}) {
    if (group == nullptr) continue;
    for (const auto& [name, unused] : group->metrics) names.insert(name);
  }
  names.erase("cpu_s");
  return names;
}

std::set<std::string> distributions_of(const CampaignReport& report, const std::string& input) {
  std::set<std::string> names;
  for (const CellResult& r : report.results) {
    for (const auto& [name, unused] : r.distributions) {
      if (r.input == input) names.insert(name);
    }
  }
  return names;
}

// "5 % / median / 95 %" in centimetres or degrees.
std::string spread_of(const std::vector<double>& quantiles, const MetricStyle& style) {
  if (quantiles.empty()) return "-";
  std::string text;
  for (const double share : {0.05, 0.5, 0.95}) {
    const auto i = static_cast<std::size_t>(std::lround(share * static_cast<double>(quantiles.size() - 1)));
    text += (text.empty() ? "" : " / ") + format_metric(style, quantiles[i]);
  }
  return text;
}

std::string distribution_row(const CampaignReport& report, const std::string& input,
                             const std::string& name) {
  const MetricStyle style = style_of(name + (name == "heading" || name == "turn" ? "_rad" : "_m"));
  const auto real = mean_quantiles(report, input, kVariantReal, name);
  const auto simulated = mean_quantiles(report, input, kVariantSimulated, name);
  const std::string distance = real.empty() || real.size() != simulated.size()
                                   ? "-"
                                   : format_metric(style, distribution_distance(real, simulated));
  return "| " + style.label + " | " + spread_of(real, style) + " | " + spread_of(simulated, style) + " | " +
         distance + " |\n";
}

}  // namespace

std::string sensor_tables(const CampaignReport& report) {
  std::set<std::string> seen;
  std::string text;
  for (const CampaignGroup& first : report.summary.groups) {
    const std::string& input = first.input;
    if (!seen.insert(input).second) continue;
    const CampaignGroup* real = group_of(report, input, kVariantReal);
    const CampaignGroup* simulated = group_of(report, input, kVariantSimulated);
    text += "\n## " + input + "\n\n| figure | real | simulated (range over " +
            std::to_string(simulated == nullptr ? 0 : simulated->cells) + " seeds) |\n|---|---:|---:|\n";
    for (const std::string& metric : metrics_of(real, simulated)) {
      text += "| " + style_of(metric).label + " | " + mean_of(real, metric) + " | " +
              mean_of(simulated, metric) + " |\n";
    }
    text +=
        "\n| measured - expected | real: 5 % / median / 95 % | simulated | mean distance "
        "|\n|---|---:|---:|---:|\n";
    for (const std::string& name : distributions_of(report, input))
      text += distribution_row(report, input, name);
  }
  return text;
}

}  // namespace cairn
