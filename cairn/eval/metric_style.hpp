#pragma once

#include <string>

namespace cairn {

/// How people read a metric: metres as centimetres, radians as degrees, shares as per cent.
struct MetricStyle {
  std::string label;  ///< "ate_mean [cm]"
  std::string unit;   ///< "cm"; may be empty
  double factor = 1.0;
  int digits = 2;  ///< after the point
};

/// By the ending of the metric's name: `_m`, `_rad`, `_s`, `_bytes`; `lost`, `*_share` and everything of a
/// stream
/// ("drop_rate.laser") are shares.
MetricStyle style_of(const std::string& metric);

/// The value in the style's unit with its digits; "-" for NaN.
std::string format_metric(const MetricStyle& style, double value);

}  // namespace cairn
