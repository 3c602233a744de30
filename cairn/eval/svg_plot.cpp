#include "cairn/eval/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cairn {
namespace {

constexpr double kWidth = 380.0, kHeight = 290.0;
constexpr double kLeft = 62.0, kRight = 12.0, kTop = 30.0, kBottom = 44.0;
constexpr double kLegendLine = 14.0;
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                   "#56b4e9", "#8a6d3b", "#555555", "#b59f00"};
constexpr double kHidden = std::numeric_limits<double>::quiet_NaN();

std::string format(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string number(double value) { return format("%.1f", value); }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

// Dark blue over green to yellow, even in brightness.
std::string shade_color(double share) {
  constexpr std::array<std::array<double, 3>, 4> kStops{
      {{68, 1, 84}, {49, 104, 142}, {53, 183, 121}, {253, 231, 37}}};
  const double at = std::clamp(share, 0.0, 1.0) * 3.0;
  const auto below = std::min<std::size_t>(2, static_cast<std::size_t>(at));
  std::array<char, 16> text{};
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] =
        static_cast<int>(std::lerp(kStops[below][k], kStops[below + 1][k], at - static_cast<double>(below)));
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(rgb[0] & 255),
                static_cast<unsigned>(rgb[1] & 255), static_cast<unsigned>(rgb[2] & 255));
  return text.data();
}

// One axis: values to places on the page.
struct Scale {
  bool logarithmic = false;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double from = 0.0, to = 1.0;

  double inner(double value) const {
    return logarithmic ? (value > 0.0 ? std::log10(value) : kHidden) : value;
  }

  void include(double value) {
    const double v = inner(value);
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }

  void settle() {
    if (!(low <= high)) low = 0.0, high = 1.0;
    if (high - low < 1e-9) low -= 0.5, high += 0.5;
  }

  double place(double value) const { return from + (inner(value) - low) / (high - low) * (to - from); }

  std::vector<double> ticks() const {
    std::vector<double> values;
    if (logarithmic && high - low >= 1.0) {
      for (double e = std::ceil(low); e <= high; e += 1.0) values.push_back(std::pow(10.0, e));
      return values;
    }
    const double lowest = logarithmic ? std::pow(10.0, low) : low,
                 highest = logarithmic ? std::pow(10.0, high) : high;
    const double rough = (highest - lowest) / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / power > 5.0 ? 10.0 * power : rough / power > 2.0 ? 5.0 * power : 2.0 * power;
    for (double v = std::ceil(lowest / step) * step; v <= highest + 1e-9 * step; v += step)
      values.push_back(std::abs(v) < 1e-9 * step ? 0.0 : v);
    return values;
  }
};

std::string text_at(double x, double y, const char* more, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + more + ">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* color) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
         number(y2) + "\" stroke=\"" + color + "\"/>\n";
}

class Panel {
 public:
  Panel(const SvgPlot& plot, double x, double y) : plot_(plot) {
    x_.logarithmic = plot.x.logarithmic;
    y_.logarithmic = plot.y.logarithmic;
    for (const SvgSeries& series : plot.series) {
      for (const SvgPoint& p : series.points) {
        x_.include(p.x);
        y_.include(p.y);
      }
    }
    x_.settle();
    y_.settle();
    x_.from = x + kLeft;
    x_.to = x + kWidth - kRight;
    y_.from = y + kHeight - kBottom;
    y_.to = y + kTop;
    if (plot.equal_axes) make_equal();
  }

  std::string render() const { return axes() + series() + legend(); }

 private:
  void make_equal() {
    const double per_x = (x_.high - x_.low) / (x_.to - x_.from),
                 per_y = (y_.high - y_.low) / (y_.from - y_.to);
    Scale& narrow = per_x < per_y ? x_ : y_;
    const double wanted = std::max(per_x, per_y) * std::abs(narrow.to - narrow.from);
    const double middle = 0.5 * (narrow.low + narrow.high);
    narrow.low = middle - 0.5 * wanted;
    narrow.high = middle + 0.5 * wanted;
  }

  std::string axes() const {
    std::string text = text_at(0.5 * (x_.from + x_.to), y_.to - 12.0,
                               "text-anchor=\"middle\" font-weight=\"bold\"", plot_.title);
    for (const double v : x_.ticks()) {
      text += line(x_.place(v), y_.from, x_.place(v), y_.to, "#e4e4e4");
      text += text_at(x_.place(v), y_.from + 15.0, "text-anchor=\"middle\"", format("%g", v));
    }
    for (const double v : y_.ticks()) {
      text += line(x_.from, y_.place(v), x_.to, y_.place(v), "#e4e4e4");
      text += text_at(x_.from - 5.0, y_.place(v) + 4.0, "text-anchor=\"end\"", format("%g", v));
    }
    text += line(x_.from, y_.from, x_.to, y_.from, "#333") + line(x_.from, y_.from, x_.from, y_.to, "#333");
    text += text_at(0.5 * (x_.from + x_.to), y_.from + 33.0, "text-anchor=\"middle\"", plot_.x.label);
    const double middle = 0.5 * (y_.from + y_.to), aside = x_.from - 46.0;
    const std::string turn =
        "text-anchor=\"middle\" transform=\"rotate(-90 " + number(aside) + " " + number(middle) + ")\"";
    return text + text_at(aside, middle, turn.c_str(), plot_.y.label);
  }

  std::string series() const {
    std::string text;
    for (std::size_t s = 0; s < plot_.series.size(); ++s) {
      const std::string color = kColors[s % std::size(kColors)];
      text += plot_.series[s].dots ? dots(plot_.series[s], color) : polyline(plot_.series[s], color);
    }
    return text;
  }

  std::string polyline(const SvgSeries& series, const std::string& color) const {
    std::string points;
    for (const SvgPoint& p : series.points) {
      const double x = x_.place(p.x), y = y_.place(p.y);
      if (std::isfinite(x) && std::isfinite(y)) points += number(x) + "," + number(y) + " ";
    }
    return "<polyline fill=\"none\" stroke-width=\"1.6\" stroke=\"" + color + "\" points=\"" + points +
           "\"/>\n";
  }

  std::string dots(const SvgSeries& series, const std::string& color) const {
    std::string text;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const double x = x_.place(series.points[i].x), y = y_.place(series.points[i].y);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      const bool shaded = i < series.shades.size();
      text += "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + (shaded ? "\" r=\"1.3" : "\" r=\"3") +
              "\" fill=\"" + (shaded ? shade_color(series.shades[i]) : color) + "\"/>\n";
    }
    return text;
  }

  std::string legend() const {
    std::string text;
    double y = y_.to + 12.0;
    for (std::size_t s = 0; s < plot_.series.size(); ++s) {
      if (plot_.series[s].name.empty() || !plot_.series[s].shades.empty()) continue;
      text += "<rect x=\"" + number(x_.from + 8.0) + "\" y=\"" + number(y - 8.0) +
              "\" width=\"10\" height=\"8\" fill=\"" + kColors[s % std::size(kColors)] + "\"/>\n" +
              text_at(x_.from + 22.0, y, "", plot_.series[s].name);
      y += kLegendLine;
    }
    return text;
  }

  const SvgPlot& plot_;
  Scale x_, y_;
};

}  // namespace

std::string render_svg(std::span<const SvgPlot> panels, int columns) {
  const auto per_row = static_cast<std::size_t>(std::max(1, columns));
  const std::size_t rows = (panels.size() + per_row - 1) / per_row;
  const double width =
      kWidth * static_cast<double>(std::min(per_row, std::max<std::size_t>(1, panels.size())));
  const double height = kHeight * static_cast<double>(rows);
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " +
                     number(height) + "\" width=\"" + number(width) + "\" height=\"" + number(height) +
                     "\" font-family=\"sans-serif\" font-size=\"11\" fill=\"#222\">\n<rect width=\"100%\" "
                     "height=\"100%\" fill=\"#fff\"/>\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t column = i % per_row, row = i / per_row;
    const Panel panel(panels[i], kWidth * static_cast<double>(column), kHeight * static_cast<double>(row));
    text += panel.render();
  }
  return text + "</svg>\n";
}

}  // namespace cairn
