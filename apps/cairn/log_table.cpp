#include "apps/cairn/log_table.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

using Row = std::vector<std::string>;

// Columns as wide as their widest cell, two blanks apart; the first column to the left, the others to the
// right.
std::string table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += '\n';
  }
  return text;
}

std::string headline(const LogSummary& summary) {
  return fmt::format("{} log: {} messages, {:.1f} s ({:.3f} to {:.3f})\n", summary.format, summary.messages,
                     to_seconds(summary.last - summary.first), to_seconds(summary.first),
                     to_seconds(summary.last));
}

// "laser scan", as the table of lasers calls it: "laser".
std::string kind_text(StreamKind kind) {
  if (kind == StreamKind::kLaserScan) return "laser";
  std::string text(name_of(kind));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string stream_table(const LogSummary& summary) {
  std::vector<Row> rows = {
      {"stream", "kind", "messages", "span s", "rate Hz", "median ms", "gaps", "longest s", "reversals"}};
  for (const StreamSummary& s : summary.streams) {
    rows.push_back({s.info.name, kind_text(s.info.kind), std::to_string(s.messages),
                    fmt::format("{:.1f}", to_seconds(s.last - s.first)), fmt::format("{:.2f}", s.rate_hz),
                    fmt::format("{:.1f}", 1e3 * s.median_period_s), std::to_string(s.gaps),
                    fmt::format("{:.2f}", s.longest_gap_s), std::to_string(s.time_reversals)});
  }
  return table(rows);
}

Row laser_row(const StreamSummary& s) {
  const LaserSummary& laser = *s.laser;
  const auto& mount = s.info.T_base_sensor;
  const bool same = laser.beams_min == laser.beams_max;
  return {s.info.name,
          same ? std::to_string(laser.beams_max) : fmt::format("{} to {}", laser.beams_min, laser.beams_max),
          fmt::format("{:.1f} to {:.1f}", radians_to_degrees(laser.first_angle_rad),
                      radians_to_degrees(laser.last_angle_rad)),
          fmt::format("{:.2f} to {:.2f}", laser.range_min_m, laser.range_max_m),
          fmt::format("{:.1f} %", 100.0 * laser.valid_share),
          mount ? fmt::format("{:.3f}, {:.3f}, {:.1f}", mount->x, mount->y, radians_to_degrees(mount->theta))
                : "unknown"};
}

std::string laser_table(const LogSummary& summary) {
  std::vector<Row> rows = {{"laser", "beams", "angles deg", "range m", "valid", "mount x m, y m, yaw deg"}};
  for (const StreamSummary& s : summary.streams) {
    if (s.laser) rows.push_back(laser_row(s));
  }
  return rows.size() > 1 ? "\n" + table(rows) : "";
}

std::string sensor_table(const LogSummary& summary) {
  std::vector<Row> rows = {{"sensor", "readings", "valid", "mount x m, y m, yaw deg"}};
  for (const StreamSummary& s : summary.streams) {
    if (!s.sensor) continue;
    const auto& [least, most, valid_share] = *s.sensor;
    const auto& mount = s.info.T_base_sensor;
    rows.push_back(
        {s.info.name, least == most ? std::to_string(most) : fmt::format("{} to {}", least, most),
         fmt::format("{:.1f} %", 100.0 * valid_share),
         mount ? fmt::format("{:.3f}, {:.3f}, {:.1f}", mount->x, mount->y, radians_to_degrees(mount->theta))
               : "unknown"});
  }
  return rows.size() > 1 ? "\n" + table(rows) : "";
}

std::string odometry_table(const LogSummary& summary) {
  std::vector<Row> rows = {{"odometry", "path m", "path m by stamp", "mean m/s"}};
  for (const StreamSummary& s : summary.streams) {
    if (!s.odometry) continue;
    const double span = to_seconds(s.last - s.first);
    rows.push_back({s.info.name, fmt::format("{:.1f}", s.odometry->path_length_m),
                    fmt::format("{:.1f}", s.odometry->path_length_by_stamp_m),
                    span > 0.0 ? fmt::format("{:.2f}", s.odometry->path_length_m / span) : "-"});
  }
  return rows.size() > 1 ? "\n" + table(rows) : "";
}

std::string warnings(const Diagnostics& diagnostics) {
  std::string text;
  for (const auto& [kind, count] : diagnostics.counts()) {
    text += fmt::format("{:>8}  {}\n", count, kind);
    for (const auto& example : diagnostics.examples()) {
      if (example.kind == kind) text += fmt::format("{:10}{}\n", "", example.text);
    }
  }
  return text.empty() ? "" : "\nwarnings\n" + text;
}

}  // namespace

std::string log_table(const LogSummary& summary) {
  return headline(summary) + "\n" + stream_table(summary) + laser_table(summary) + sensor_table(summary) +
         odometry_table(summary) + warnings(summary.diagnostics);
}

}  // namespace cairn::app
