#include "cairn/io/log_summary.hpp"

#include "cairn/core/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

constexpr double kGapInPeriods = 5.0;

double last_angle(const LaserScan& scan) {
  return scan.angle_min_rad + scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0);
}

/// How many readings a message has, and how many of them say something.
struct Readings {
  std::size_t all = 0;
  std::size_t valid = 0;
};

Readings readings_in(const SonarScan& scan) {
  const auto valid = std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(),
                                   [&](float range) { return scan.is_valid_range(range); });
  return {scan.ranges_m.size(), static_cast<std::size_t>(valid)};
}

Readings readings_in(const DepthImage& image) {
  const auto says = [](auto depth) {
    const auto metres = static_cast<float>(depth);
    return metres > 0.0F && std::isfinite(metres);
  };
  return std::visit(
      [&](const auto& depths) {
        const auto valid = std::count_if(depths.begin(), depths.end(), says);
        return Readings{depths.size(), static_cast<std::size_t>(valid)};
      },
      image.depths);
}

Readings readings_in(const WifiScan& scan) { return {scan.readings.size(), scan.readings.size()}; }

Readings readings_in(const BeaconRanges& ranges) {
  const auto valid = std::count_if(ranges.readings.begin(), ranges.readings.end(),
                                   [](const BeaconReading& reading) { return !std::isnan(reading.range_m); });
  return {ranges.readings.size(), static_cast<std::size_t>(valid)};
}

Readings readings_in(const LandmarkDetections& seen) {
  const auto valid =
      std::count_if(seen.detections.begin(), seen.detections.end(),
                    [](const LandmarkDetection& d) { return d.id != LandmarkDetection::kUnknown; });
  return {seen.detections.size(), static_cast<std::size_t>(valid)};
}

Readings readings_in(const CeilingPatch& patch) { return {patch.gray.size(), patch.gray.size()}; }
Readings readings_in(const ImuYawRate&) { return {1, 1}; }

/// Collects what one stream says.
class StreamTally {
 public:
  void add(Time stamp, const Odometry& odometry) {
    stamps_.push_back(stamp);
    trajectory_.push_back({odometry.stamp, odometry.T_odom_base});
  }

  void add(Time stamp, const LaserScan& scan) {
    stamps_.push_back(stamp);
    const std::size_t beams = scan.ranges_m.size();
    if (!laser_) {
      laser_ = {beams, beams, scan.angle_min_rad, last_angle(scan), scan.range_min_m, scan.range_max_m, 0.0};
    }
    laser_->beams_min = std::min(laser_->beams_min, beams);
    laser_->beams_max = std::max(laser_->beams_max, beams);
    readings_ += beams;
    valid_ += static_cast<std::size_t>(std::count_if(
        scan.ranges_m.begin(), scan.ranges_m.end(), [&](float range) { return scan.is_valid_range(range); }));
  }

  template <class Other>
  void add(Time stamp, const Other& measurement) {
    stamps_.push_back(stamp);
    const Readings now = readings_in(measurement);
    if (!other_) other_ = {now.all, now.all, 0.0};
    other_->readings_min = std::min(other_->readings_min, now.all);
    other_->readings_max = std::max(other_->readings_max, now.all);
    readings_ += now.all;
    valid_ += now.valid;
  }

  StreamSummary summary(const StreamInfo& info) {
    StreamSummary summary;
    summary.info = info;
    summarize_stamps(summary);
    if (info.kind == StreamKind::kOdometry) {
      const double in_order_of_file = path_length(trajectory_);
      sort_by_stamp(trajectory_);
      summary.odometry = OdometrySummary{in_order_of_file, path_length(trajectory_)};
    }
    if (laser_ && readings_ > 0)
      laser_->valid_share = static_cast<double>(valid_) / static_cast<double>(readings_);
    if (other_ && readings_ > 0)
      other_->valid_share = static_cast<double>(valid_) / static_cast<double>(readings_);
    summary.laser = laser_;
    summary.sensor = other_;
    return summary;
  }

 private:
  void summarize_stamps(StreamSummary& summary) {
    summary.messages = stamps_.size();
    if (stamps_.empty()) return;
    for (std::size_t i = 1; i < stamps_.size(); ++i)
      summary.time_reversals += stamps_[i] < stamps_[i - 1] ? 1 : 0;
    std::sort(stamps_.begin(), stamps_.end());
    summary.first = stamps_.front();
    summary.last = stamps_.back();
    const double span = to_seconds(summary.last - summary.first);
    if (span > 0.0) summary.rate_hz = static_cast<double>(stamps_.size() - 1) / span;
    summarize_periods(summary);
  }

  void summarize_periods(StreamSummary& summary) const {
    std::vector<double> periods;
    for (std::size_t i = 1; i < stamps_.size(); ++i)
      periods.push_back(to_seconds(stamps_[i] - stamps_[i - 1]));
    if (periods.empty()) return;
    std::sort(periods.begin(), periods.end());
    summary.median_period_s = periods[periods.size() / 2];
    summary.longest_gap_s = periods.back();
    const auto first_gap =
        std::upper_bound(periods.begin(), periods.end(), kGapInPeriods * summary.median_period_s);
    summary.gaps = static_cast<std::size_t>(periods.end() - first_gap);
  }

  std::vector<Time> stamps_;  // in the order of the file until summarized
  Trajectory trajectory_;
  std::optional<LaserSummary> laser_;
  std::optional<SensorSummary> other_;
  std::size_t readings_ = 0;
  std::size_t valid_ = 0;
};

nlohmann::ordered_json json_of(const LaserSummary& laser) {
  return {{"beams_min", laser.beams_min},
          {"beams_max", laser.beams_max},
          {"first_angle_rad", laser.first_angle_rad},
          {"last_angle_rad", laser.last_angle_rad},
          {"range_min_m", laser.range_min_m},
          {"range_max_m", laser.range_max_m},
          {"valid_share", laser.valid_share}};
}

nlohmann::ordered_json json_of(const StreamSummary& stream) {
  nlohmann::ordered_json mount;
  if (const auto& T = stream.info.T_base_sensor)
    mount = {{"x_m", T->x}, {"y_m", T->y}, {"theta_rad", T->theta}};
  nlohmann::ordered_json json = {{"name", stream.info.name},
                                 {"kind", name_of(stream.info.kind)},
                                 {"frame", stream.info.frame},
                                 {"T_base_sensor", mount},
                                 {"messages", stream.messages},
                                 {"start_s", to_seconds(stream.first)},
                                 {"end_s", to_seconds(stream.last)},
                                 {"rate_hz", stream.rate_hz},
                                 {"median_period_s", stream.median_period_s},
                                 {"gaps", stream.gaps},
                                 {"longest_gap_s", stream.longest_gap_s},
                                 {"time_reversals", stream.time_reversals}};
  if (stream.laser) json["laser"] = json_of(*stream.laser);
  if (stream.sensor) {
    json["sensor"] = {{"readings_min", stream.sensor->readings_min},
                      {"readings_max", stream.sensor->readings_max},
                      {"valid_share", stream.sensor->valid_share}};
  }
  if (stream.odometry) {
    json["odometry"] = {{"path_length_m", stream.odometry->path_length_m},
                        {"path_length_by_stamp_m", stream.odometry->path_length_by_stamp_m}};
  }
  return json;
}

nlohmann::ordered_json json_of(const Diagnostics& diagnostics) {
  auto warnings = nlohmann::ordered_json::array();
  for (const auto& [kind, count] : diagnostics.counts()) {
    auto examples = nlohmann::ordered_json::array();
    for (const auto& example : diagnostics.examples()) {
      if (example.kind == kind) examples.push_back(example.text);
    }
    warnings.push_back({{"kind", kind}, {"count", count}, {"examples", examples}});
  }
  return warnings;
}

}  // namespace

LogSummary summarize(const Log& log) {
  std::vector<StreamTally> tallies(log.streams.size());
  for (const Event& event : log.events) {
    visit_payload(event,
                  [&](const auto& measurement) { tallies[event.stream].add(event.stamp, measurement); });
  }
  LogSummary summary;
  summary.format = log.format;
  summary.messages = log.events.size();
  summary.diagnostics = log.diagnostics;
  for (std::size_t i = 0; i < tallies.size(); ++i)
    summary.streams.push_back(tallies[i].summary(log.streams[i]));
  if (log.events.empty()) return summary;
  const auto [first, last] = std::minmax_element(
      log.events.begin(), log.events.end(), [](const Event& a, const Event& b) { return a.stamp < b.stamp; });
  summary.first = first->stamp;
  summary.last = last->stamp;
  return summary;
}

std::string to_json(const LogSummary& summary) {
  auto streams = nlohmann::ordered_json::array();
  for (const StreamSummary& stream : summary.streams) streams.push_back(json_of(stream));
  const nlohmann::ordered_json json = {{"format", summary.format},
                                       {"messages", summary.messages},
                                       {"start_s", to_seconds(summary.first)},
                                       {"end_s", to_seconds(summary.last)},
                                       {"span_s", to_seconds(summary.last - summary.first)},
                                       {"streams", streams},
                                       {"warnings", json_of(summary.diagnostics)}};
  // A file name or frame may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace cairn
