#pragma once

#include <span>
#include <string>
#include <vector>

namespace cairn {

struct SvgPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A line, or dots.
struct SvgSeries {
  std::string name;
  std::vector<SvgPoint>
      points;  ///< those that are not finite, or not positive on a logarithmic axis, are left out
  bool dots = false;
  /// Of dots: 0 (dark) to 1 (bright) for each, instead of the colour of the series; empty: none.
  std::vector<double> shades = {};
};

struct SvgAxis {
  std::string label;
  bool logarithmic = false;
};

/// One panel with axes. Its limits are those of the points.
struct SvgPlot {
  std::string title;
  SvgAxis x, y;
  bool equal_axes = false;  ///< a metre is as long on both
  std::vector<SvgSeries> series;
};

/// The panels side by side, `columns` in a row, as one SVG text that needs nothing else.
std::string render_svg(std::span<const SvgPlot> panels, int columns);

}  // namespace cairn
