#include "apps/cairn/ambiguity_picture.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/eval/base64.hpp"
#include "cairn/io/png.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr int kMargin_cells = 10;
constexpr const char* kNeverColour = "#5e3c99";
using Colour = std::array<double, 3>;
constexpr Colour kSoon = {253, 212, 80};
constexpr Colour kLate = {200, 20, 30};

/// The part of the map that is known.
struct Frame {
  int left = 0, bottom = 0, columns = 1, rows = 1;
};

Frame frame_of(const OccupancyGrid& map) {
  const GridGeometry& grid = map.geometry();
  int left = grid.width, right = 0, bottom = grid.height, top = 0;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      if (map.state(grid.index(column, row)) == CellState::kUnknown) continue;
      left = std::min(left, column), right = std::max(right, column);
      bottom = std::min(bottom, row), top = std::max(top, row);
    }
  }
  left = std::max(0, left - kMargin_cells), bottom = std::max(0, bottom - kMargin_cells);
  right = std::min(grid.width - 1, right + kMargin_cells),
  top = std::min(grid.height - 1, top + kMargin_cells);
  return {left, bottom, std::max(1, right - left + 1), std::max(1, top - bottom + 1)};
}

std::uint8_t gray_of(CellState state) {
  switch (state) {
    case CellState::kFree:
      return 255;
    case CellState::kOccupied:
      return 0;
    case CellState::kUnknown:
      break;
  }
  return 225;
}

std::string map_picture(const OccupancyGrid& map, const Frame& frame) {
  GrayImage image{frame.columns, frame.rows, {}, {}};
  for (int row = frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < frame.columns; ++column)
      image.gray.push_back(gray_of(map.state(map.geometry().index(frame.left + column, frame.bottom + row))));
  }
  std::ostringstream png;
  write_png(png, image);
  return to_base64(png.str());
}

std::string colour_of(double resolved_after_m, double farthest_m) {
  if (!std::isfinite(resolved_after_m)) return kNeverColour;
  const double share = farthest_m > 0.0 ? std::clamp(resolved_after_m / farthest_m, 0.0, 1.0) : 0.0;
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < 3; ++i)
    mixed[i] = static_cast<int>(std::lround(kSoon[i] + share * (kLate[i] - kSoon[i])));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

std::string tooltip(const SelfSimilarPlace& place) {
  const Pose2& own = place.T_map_sensor;
  const Pose2& other = place.alternatives[0].T_map_sensor;
  const std::string when = std::isfinite(place.resolved_after_m)
                               ? fmt::format("told apart after {:.1f} m", place.resolved_after_m)
                               : std::string("not told apart");
  return fmt::format("({:.1f}, {:.1f}, {:.0f} deg) looks like ({:.1f}, {:.1f}, {:.0f} deg): {}", own.x, own.y,
                     radians_to_degrees(own.theta), other.x, other.y, radians_to_degrees(other.theta), when);
}

std::string legend(double width, double y, double farthest_m) {
  const double box = width / 60.0;
  std::string svg = fmt::format("<g font-family='sans-serif' font-size='{:.1f}' fill='#333'>", 1.2 * box);
  const std::array<std::pair<std::string, std::string>, 4> entries = {
      {{colour_of(0.0, farthest_m), "told apart by turning"},
       {colour_of(0.5 * farthest_m, farthest_m), fmt::format("after {:.0f} m of driving", 0.5 * farthest_m)},
       {colour_of(farthest_m, farthest_m), fmt::format("after {:.0f} m", farthest_m)},
       {kNeverColour, fmt::format("not within {:.0f} m", farthest_m)}}};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = width * 0.25 * static_cast<double>(i) + box;
    svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>", x, y, box,
                       box, entries[i].first);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}'>{}</text>", x + 1.5 * box, y + box, entries[i].second);
  }
  return svg + "</g>\n";
}

}  // namespace

std::string ambiguity_svg(const AmbiguityView& view) {
  const Frame frame = frame_of(view.map);
  const GridGeometry& grid = view.map.geometry();
  const double width = std::max(frame.columns, 120);
  const double foot = width / 20.0;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {:.0f} {:.1f}'>\n"
      "<rect width='100%' height='100%' fill='#fff'/>\n"
      "<image width='{}' height='{}' style='image-rendering:pixelated' href='data:image/png;base64,{}'/>\n<g "
      "fill-opacity='0.75'>\n",
      width, frame.rows + foot, frame.columns, frame.rows, map_picture(view.map, frame));
  const double side = view.spacing_m / grid.resolution_m;
  for (const SelfSimilarPlace& place : view.places) {
    if (place.alternatives.empty()) continue;
    const Point2 cell = grid.to_cells({place.T_map_sensor.x, place.T_map_sensor.y});
    svg += fmt::format(
        "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'><title>{}</title></rect>\n",
        cell.x - frame.left - 0.5 * side, frame.rows - (cell.y - frame.bottom) - 0.5 * side, side, side,
        colour_of(place.resolved_after_m, view.farthest_drive_m), tooltip(place));
  }
  return svg + "</g>\n" + legend(width, frame.rows + 0.3 * foot, view.farthest_drive_m) + "</svg>\n";
}

std::string ambiguity_page(const AmbiguityView& view, const std::string& title,
                           const std::vector<std::string>& lines) {
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
                     "</title>\n<style>body{font:16px/1.5 sans-serif;max-width:1200px;margin:2em "
                     "auto;padding:0 1em;color:#222}"
                     "svg{width:100%;height:auto;border:1px solid #ddd}</style></head>\n<body><h1>" +
                     title + "</h1>\n<ul>\n";
  for (const std::string& line : lines) page += "<li>" + line + "</li>\n";
  return page + "</ul>\n" + ambiguity_svg(view) + "</body></html>\n";
}

}  // namespace cairn::app
