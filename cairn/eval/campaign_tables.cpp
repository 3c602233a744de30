#include "cairn/eval/campaign_tables.hpp"

#include "cairn/eval/campaign_figures.hpp"
#include "cairn/eval/metric_style.hpp"
#include "cairn/eval/page.hpp"
#include "cairn/eval/sensor_tables.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kUsual[] = {"ate_mean_m", "rpe_translation_m", "rpe_rotation_rad", "lost", "cpu_s"};
constexpr const char* kDropRate = "drop_rate.";

std::set<std::string> all_metrics(const std::vector<CellResult>& results) {
  std::set<std::string> names;
  for (const CellResult& result : results) {
    for (const auto& [name, unused] : result.metrics) names.insert(name);
  }
  return names;
}

// Drop rates of the sensors first, as in MuSe's Table I, then accuracy and cost.
std::vector<std::string> usual_columns(const std::set<std::string>& present) {
  std::vector<std::string> columns;
  for (const std::string& name : present) {
    if (name.rfind(kDropRate, 0) == 0) columns.push_back(name);
  }
  for (const char* name : kUsual) {
    if (present.count(name) != 0) columns.emplace_back(name);
  }
  return columns;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string number(double value) { return Json(value).dump(); }

// NaN becomes null.
Json interval_json(const MeanInterval& interval) {
  return {{"count", interval.count}, {"mean", interval.mean}, {"low", interval.low}, {"high", interval.high}};
}

Json group_json(const CampaignGroup& group) {
  Json metrics = Json::object();
  for (const auto& [name, interval] : group.metrics) {
    metrics[name] = interval_json(interval);
    metrics[name]["min"] = group.smallest.at(name);
    metrics[name]["median"] = group.median.at(name);
    metrics[name]["max"] = group.largest.at(name);
  }
  return {{"input", group.input}, {"variant", group.variant}, {"cells", group.cells}, {"metrics", metrics}};
}

Json comparison_json(const CampaignComparison& c) {
  return {{"input", c.input},
          {"variant", c.variant},
          {"baseline", c.baseline},
          {"metric", c.metric},
          {"difference", interval_json(c.paired.difference)},
          {"p_value", c.paired.p_value}};
}

Json result_json(const CellResult& result) {
  return {{"input", result.input},     {"recipe", result.recipe},  {"parameters", result.parameters},
          {"variant", result.variant}, {"seed", result.seed},      {"command", result.command},
          {"program", result.program}, {"metrics", result.metrics}};
}

Json styles_json(const CampaignReport& report) {
  Json styles = Json::object();
  for (const std::string& name : all_metrics(report.results)) {
    const MetricStyle style = style_of(name);
    styles[name] = {
        {"label", style.label}, {"unit", style.unit}, {"factor", style.factor}, {"digits", style.digits}};
  }
  return styles;
}

Json report_json(const CampaignReport& report) {
  Json json = {{"title", report.title},
               {"about", report.about},
               {"baseline", report.baseline},
               {"cells", report.cells},
               {"finished", report.results.size()},
               {"columns", report.metrics},
               {"styles", styles_json(report)},
               {"groups", Json::array()},
               {"comparisons", Json::array()},
               {"results", Json::array()}};
  for (const CampaignGroup& group : report.summary.groups) json["groups"].push_back(group_json(group));
  for (const CampaignComparison& c : report.summary.comparisons)
    json["comparisons"].push_back(comparison_json(c));
  for (const CellResult& result : report.results) json["results"].push_back(result_json(result));
  return json;
}

Json rounded(const std::vector<double>& values, double scale) {
  Json json = Json::array();
  for (const double value : values) json.push_back(std::round(value * scale) / scale);
  return json;
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string rule(std::size_t texts, std::size_t numbers) {
  std::string text = "|";
  for (std::size_t i = 0; i < texts; ++i) text += "---|";
  for (std::size_t i = 0; i < numbers; ++i) text += "---:|";
  return text + "\n";
}

std::string with_interval(const MetricStyle& style, const MeanInterval& interval) {
  std::string mean = format_metric(style, interval.mean);
  if (!(interval.low < interval.high)) return mean;  // one value, or all alike
  return mean + " [" + format_metric(style, interval.low) + ", " + format_metric(style, interval.high) + "]";
}

std::string groups_table(const CampaignReport& report) {
  std::vector<std::string> header{"input", "variant", "runs"};
  for (const std::string& metric : report.metrics) header.push_back(style_of(metric).label);
  std::string text = row(header) + rule(2, header.size() - 2);
  for (const CampaignGroup& group : report.summary.groups) {
    std::vector<std::string> cells{group.input, group.variant, std::to_string(group.cells)};
    for (const std::string& metric : report.metrics) {
      const auto found = group.metrics.find(metric);
      cells.push_back(found == group.metrics.end() ? "-" : with_interval(style_of(metric), found->second));
    }
    text += row(cells);
  }
  return text;
}

bool is_length(const std::string& metric) {
  return metric.size() > 2 && metric.compare(metric.size() - 2, 2, "_m") == 0;
}

// As the table of Biswas & Veloso, section 4: what a mean hides when a few runs of many go astray.
std::string spread_table(const CampaignReport& report) {
  std::string text;
  for (const CampaignGroup& group : report.summary.groups) {
    for (const std::string& metric : report.metrics) {
      if (group.cells < 2 || !is_length(metric) || group.metrics.count(metric) == 0) continue;
      const MetricStyle style = style_of(metric);
      text += row({group.input, group.variant, style.label, format_metric(style, group.smallest.at(metric)),
                   format_metric(style, group.median.at(metric)),
                   format_metric(style, group.largest.at(metric))});
    }
  }
  if (text.empty()) return text;
  return "\nSmallest, median and largest of the runs:\n\n" +
         row({"input", "variant", "metric", "min", "median", "max"}) + rule(3, 3) + text;
}

std::string p_text(double p) { return p < 0.001 ? "< 0.001" : format_metric({"", "", 1.0, 3}, p); }

std::string comparisons_table(const CampaignReport& report) {
  std::string text = row({"input", "variant", "metric", "pairs", "difference [95 %]", "p"}) + rule(3, 3);
  for (const CampaignComparison& c : report.summary.comparisons) {
    if (std::find(report.metrics.begin(), report.metrics.end(), c.metric) == report.metrics.end()) continue;
    const MetricStyle style = style_of(c.metric);
    text += row({c.input, c.variant, style.label, std::to_string(c.paired.difference.count),
                 with_interval(style, c.paired.difference), p_text(c.paired.p_value)});
  }
  return text;
}

}  // namespace

CampaignReport make_campaign_report(const Campaign& campaign, std::vector<CellResult> results) {
  CampaignReport report;
  report.title = campaign.title.empty() ? "Campaign" : campaign.title;
  report.about = campaign.about;
  report.sensors = campaign.measures_sensors();
  const std::vector<CampaignCell> cells = campaign.cells();
  report.cells = cells.size();
  report.baseline = campaign.baseline.empty() ? cells.front().variant : campaign.baseline;
  report.results = std::move(results);
  report.metrics = split_words(campaign.metrics);
  if (report.metrics.empty()) {
    const std::set<std::string> present = all_metrics(report.results);
    report.metrics =
        report.sensors ? std::vector<std::string>(present.begin(), present.end()) : usual_columns(present);
  }
  if (report.sensors) report.baseline = "";  // one log, many simulations: there are no pairs
  report.summary = summarize_campaign(report.results, report.baseline, campaign.bootstrap());
  return report;
}

std::string to_csv(const CampaignReport& report) {
  const std::set<std::string> metrics = all_metrics(report.results);
  std::string text = "input,recipe,parameters,variant,seed";
  for (const std::string& name : metrics) text += "," + csv_field(name);
  text += "\n";
  for (const CellResult& r : report.results) {
    text += csv_field(r.input) + "," + csv_field(r.recipe) + "," + csv_field(r.parameters) + "," +
            csv_field(r.variant) + "," + std::to_string(r.seed);
    for (const std::string& name : metrics) {
      const auto found = r.metrics.find(name);
      text += "," + (found == r.metrics.end() ? std::string() : number(found->second));
    }
    text += "\n";
  }
  return text;
}

std::string to_json(const CampaignReport& report) {
  return report_json(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_markdown(const CampaignReport& report) {
  std::string text = "# " + report.title + "\n\n";
  if (!report.about.empty()) text += report.about + (report.about.back() == '\n' ? "\n" : "\n\n");
  if (report.sensors) {
    return text + std::to_string(report.results.size()) + " of " + std::to_string(report.cells) + " runs.\n" +
           sensor_tables(report);
  }
  text += std::to_string(report.results.size()) + " of " + std::to_string(report.cells) +
          " runs. Means over the runs, in brackets the bootstrap 95 % interval of the mean.\n\n" +
          groups_table(report) + spread_table(report);
  if (!report.summary.comparisons.empty()) {
    text += "\nDifference to `" + report.baseline +
            "` on the same input with the same seed (sign-flip test, two-sided):\n\n" +
            comparisons_table(report);
  }
  return text;
}

std::string render_campaign(std::string_view page, const CampaignReport& report) {
  Json json = report_json(report);
  json["traces"] = Json::array();
  for (const CellResult& r : report.results) {
    json["traces"].push_back({{"t", rounded(r.trace.t_s, 10.0)},
                              {"x", rounded(r.trace.x_m, 100.0)},
                              {"y", rounded(r.trace.y_m, 100.0)},
                              {"e", rounded(r.trace.error_m, 1000.0)}});
  }
  json["figures"] = Json::array();
  if (report.sensors) {
    for (const CampaignFigure& figure : campaign_figures(report)) json["figures"].push_back(figure.svg);
  }
  return fill_page(page, json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace cairn
