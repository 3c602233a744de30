#include "cairn/eval/metric_style.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace cairn {
namespace {

struct Ending {
  std::string_view text;
  const char* unit;
  double factor;
  int digits;
};

constexpr double kPerMebibyte = 1.0 / (1024.0 * 1024.0);
const Ending kEndings[] = {{"_m", "cm", 100.0, 2},
                           {"_rad", "deg", radians_to_degrees(1.0), 2},
                           {"_s", "s", 1.0, 2},
                           {"_bytes", "MiB", kPerMebibyte, 0},
                           {"_share", "%", 100.0, 1}};

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() > ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

MetricStyle style_of(const std::string& metric) {
  if (metric.find('.') != std::string::npos || metric == "lost" || metric == "coverage") {
    return {metric + " [%]", "%", 100.0, 1};
  }
  for (const Ending& ending : kEndings) {
    if (!ends_with(metric, ending.text)) continue;
    const std::string name = metric.substr(0, metric.size() - ending.text.size());
    return {name + " [" + ending.unit + "]", ending.unit, ending.factor, ending.digits};
  }
  return {metric, "", 1.0, 2};
}

std::string format_metric(const MetricStyle& style, double value) {
  if (!std::isfinite(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", style.digits, style.factor * value);
  return text;
}

}  // namespace cairn
