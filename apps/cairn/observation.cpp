#include "apps/cairn/observation.hpp"

#include "apps/cairn/map_building.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/trajectory.hpp"
#include "cairn/models/sensor/beam_selection.hpp"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr double kScanEvery_m = 0.5;
constexpr double kScanEvery_rad = 0.5;

using Scan = std::shared_ptr<const LaserScan>;

std::vector<Scan> scans_of(const Log& log, StreamId stream) {
  std::vector<Scan> scans;
  for (const Event& event : log.events) {
    if (event.stream == stream) scans.push_back(std::get<Scan>(event.payload));
  }
  return scans;
}

std::size_t scan_at(const std::vector<Scan>& scans, double at_s) {
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (to_seconds(scans[i]->stamp - scans.front()->stamp) >= at_s) return i;
  }
  const double span_s = scans.empty() ? 0.0 : to_seconds(scans.back()->stamp - scans.front()->stamp);
  throw ConfigurationError("--at", fmt::format("is {} s, but the log's scans span {:.1f} s", at_s, span_s),
                           "give seconds after the first scan");
}

Trajectory odometry_of(const Log& log, const std::string& wanted) {
  Trajectory odometry;
  std::optional<StreamId> stream;
  for (const Event& event : log.events) {
    const auto* sample = std::get_if<Odometry>(&event.payload);
    if (sample == nullptr || (!wanted.empty() && log.streams[event.stream].name != wanted)) continue;
    if (stream.value_or(event.stream) != event.stream) continue;
    stream = event.stream;
    odometry.push_back({sample->stamp, sample->T_odom_base});
  }
  sort_by_stamp(odometry);
  return odometry;
}

struct Mounted {
  BeamLimits limits;
  Pose2 T_base_sensor;
};

Mounted mounted(const Log& log, StreamId stream, const LocalizerOptions& options) {
  const StreamInfo& info = log.streams[stream];
  const auto configured = options.streams.find(info.name);
  const LaserStreamOptions laser =
      configured == options.streams.end() ? LaserStreamOptions{} : configured->second;
  const bool from_log = laser.mount_from_log && info.T_base_sensor;
  return {laser.limits, from_log ? *info.T_base_sensor : laser.T_base_sensor};
}

/// Joins scans, the last one first, until the robot was too far away.
class Joiner {
 public:
  Joiner(const Mounted& laser, int max_beams) : laser_(laser), max_beams_(max_beams) {}

  void add(const LaserScan& scan, const Pose2& T_last_base) {
    for (const Point2& p : select_end_points(scan, laser_.T_base_sensor, laser_.limits, max_beams_))
      seen_.points.push_back(T_last_base * p);
    ++seen_.scans;
    T_last_joined_ = T_last_base;
  }
  bool is_due(const Pose2& T_last_base) const {
    const Pose2 step = between(T_last_joined_, T_last_base);
    return std::hypot(step.x, step.y) >= kScanEvery_m || std::abs(step.theta) >= kScanEvery_rad;
  }
  Observation& seen() { return seen_; }

 private:
  Mounted laser_;
  int max_beams_;
  Pose2 T_last_joined_;
  Observation seen_;
};

void join_earlier(Joiner& joiner, const std::vector<Scan>& scans, std::size_t last,
                  const Trajectory& odometry, double path_m) {
  const auto T_odom_last = pose_at(odometry, scans[last]->stamp);
  if (!T_odom_last) throw ConfigurationError("--path", "no odometry around the scan", "take another --at");
  Pose2 T_last_later;
  for (std::size_t i = last; i-- > 0;) {
    const auto T_odom_base = pose_at(odometry, scans[i]->stamp);
    if (!T_odom_base) return;
    const Pose2 T_last_base = between(*T_odom_last, *T_odom_base);
    joiner.seen().path_m += distance(T_last_base, T_last_later);
    if (joiner.seen().path_m > path_m) return;
    T_last_later = T_last_base;
    if (joiner.is_due(T_last_base)) joiner.add(*scans[i], T_last_base);
  }
}

}  // namespace

Observation observe(const Log& log, const LocalizerOptions& options, const ObservationRequest& request) {
  const StreamId stream = laser_stream(log, request.stream);
  const std::vector<Scan> scans = scans_of(log, stream);
  const std::size_t last = scan_at(scans, request.at_s);
  const bool joins = request.path_m > 0.0;
  Joiner joiner(mounted(log, stream, options), joins ? options.laser.likelihood_field.max_beams : 0);
  joiner.add(*scans[last], {});
  if (joins) {
    const Trajectory odometry = odometry_of(log, options.odometry_stream);
    if (odometry.empty())
      throw ConfigurationError("--path", "the log has no odometry to join scans by", "leave it out");
    join_earlier(joiner, scans, last, odometry, request.path_m);
  }
  joiner.seen().stamp = scans[last]->stamp;
  return joiner.seen();
}

}  // namespace cairn::app
