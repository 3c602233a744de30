#pragma once

#include "cairn/core/rng.hpp"
#include "small_room.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace cairn::test {

/// Five seconds of a robot on a circle in the small room: odometry at 20 Hz, a laser at 10 Hz, another one at
/// 5 Hz, and faults of every kind in the order in which the messages arrive. A function of its seed.
class FaultSchedule {
 public:
  static constexpr double kEnd_s = 5.0;
  static constexpr StreamId kOdometry = 0, kFront = 1, kRear = 2;

  enum class Kind {
    kDisorder,  ///< late, lost, duplicated, shuffled, silent: every stamp and value is true
    kWild,      ///< besides: wrong stamps and arrivals, NaN, missing beams, wrong streams, until kWildUntil_s
  };
  static constexpr double kWildUntil_s = 2.5;

  FaultSchedule(Kind kind, std::uint64_t seed) : random_(seed, RandomPurpose::kSimulation, 0) {
    for (const StreamId stream : {kOdometry, kFront, kRear}) add_stream(stream, kind);
    if (kind == Kind::kWild) spoil();
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Sent& a, const Sent& b) { return a.at < b.at; });
  }

  static std::vector<StreamInfo> streams() {
    return {{"odom", StreamKind::kOdometry, "", {}},
            {"front", StreamKind::kLaserScan, "", Pose2{}},
            {"rear", StreamKind::kLaserScan, "", Pose2{}}};
  }
  static Pose2 start() { return {2.0, 1.5, 0.0}; }

  std::vector<Event> by_arrival() const {
    std::vector<Event> events;
    for (const Sent& sent : events_) events.push_back(sent.event);
    return events;
  }

  std::vector<Event> by_stamp() const {
    std::vector<Event> events = by_arrival();
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      return a.stamp != b.stamp ? a.stamp < b.stamp : a.stream < b.stream;
    });
    return events;
  }

 private:
  struct Sent {
    double at;
    Event event;
  };

  double uniform() { return random_.uniform4(item_++)[0]; }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  bool chance(double p) { return uniform() < p; }

  // The scan at 0.1 s * i, made once.
  static const std::shared_ptr<const LaserScan>& scan(int i) {
    static const std::vector<std::shared_ptr<const LaserScan>> kScans = [] {
      std::vector<std::shared_ptr<const LaserScan>> scans;
      const OccupancyGrid map = small_room();
      for (int k = 0; k <= 50; ++k) {
        const LaserScan seen = scan_from(map, on_circle(start(), 0.1 * k), cairn::test::at(0.1 * k), 16);
        scans.push_back(std::make_shared<const LaserScan>(seen));
      }
      return scans;
    }();
    return kScans[static_cast<std::size_t>(i)];
  }

  static Event message(StreamId stream, int tick) {  // ticks of 50 ms
    if (stream == kOdometry) return odometry_event(0.05 * tick, on_circle({}, 0.05 * tick));
    return {at(0.05 * tick), at(0.05 * tick), stream, scan(tick / 2)};
  }

  void add_stream(StreamId stream, Kind kind) {
    const int every = stream == kOdometry ? 1 : stream == kFront ? 2 : 4;
    const double latency = chance(0.5) ? uniform(0.0, 0.8) : uniform(0.0, 0.05);
    const double jitter = chance(0.5) ? uniform(0.0, 0.6) : 0.0;
    const double lost = chance(0.3) ? 0.3 : 0.0, duplicated = chance(0.3) ? 0.2 : 0.0;
    const double silence = chance(0.4) ? uniform(0.0, 4.0) : kEnd_s;  // one second from here on
    const bool tail_is_clean = kind == Kind::kWild;
    for (int tick = 0; tick <= 100; tick += every) {
      const double t = 0.05 * tick;
      const bool clean = tail_is_clean && t > kWildUntil_s;
      if (!clean && (chance(lost) || (t > silence && t < silence + 1.0))) continue;
      const double when = t + (clean ? 0.01 : latency + jitter * uniform());
      add(message(stream, tick), when);
      if (!clean && chance(duplicated)) add(message(stream, tick), when + uniform(0.0, 0.3));
    }
  }

  void add(Event event, double when) {
    event.arrival = at(when);
    events_.push_back({when, std::move(event)});
  }

  double wrong_time(double t) {
    const double times[] = {-1e6, 0.0, 1e6, 9e9, -9e9, 20.0, 3.2e7, t + 1.4, t - 3.0, t + 0.7};
    return times[static_cast<std::size_t>(10 * uniform())];
  }

  void spoil() {
    const double share = uniform(0.02, 0.3);
    for (Sent& sent : events_) {
      if (to_seconds(sent.event.stamp) <= kWildUntil_s && sent.at < kWildUntil_s && chance(share))
        spoil(sent);
    }
  }

  void spoil(Sent& sent) {
    Event& event = sent.event;
    const double t = to_seconds(event.stamp);
    switch (static_cast<int>(8 * uniform())) {
      case 0:
        restamp(event, wrong_time(t));
        break;
      case 1:  // many logs know no arrival: a wrong stamp is a wrong arrival, too
        restamp(event, wrong_time(t));
        event.arrival = event.stamp;
        break;
      case 2:
        event.arrival = at(wrong_time(t));
        break;
      case 3:
        event.stream = static_cast<StreamId>(5 * uniform());
        break;
      case 4:
        event.stamp += Duration(1);
        break;
      case 5:
        event.stamp = event.arrival = chance(0.5) ? Time::max() : Time::min();
        break;
      default:
        spoil_payload(event);
    }
  }

  static void restamp(Event& event, double seconds) {
    event.stamp = at(seconds);
    if (auto* odometry = std::get_if<Odometry>(&event.payload)) {
      odometry->stamp = event.stamp;
      return;
    }
    LaserScan scan = *std::get<std::shared_ptr<const LaserScan>>(event.payload);
    scan.stamp = event.stamp;
    event.payload = std::make_shared<const LaserScan>(std::move(scan));
  }

  void spoil_payload(Event& event) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (auto* odometry = std::get_if<Odometry>(&event.payload)) {
      (chance(0.5) ? odometry->T_odom_base.x : odometry->T_odom_base.theta) = chance(0.7) ? kNan : 1e300;
      return;
    }
    LaserScan scan = *std::get<std::shared_ptr<const LaserScan>>(event.payload);
    const double which = uniform();
    if (which < 0.25) scan.ranges_m.clear();
    if (which >= 0.25 && which < 0.5) scan.angle_increment_rad = kNan;
    if (which >= 0.5) std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), static_cast<float>(kNan));
    event.payload = chance(0.1) ? nullptr : std::make_shared<const LaserScan>(std::move(scan));
  }

  RandomStream random_;
  std::uint32_t item_ = 0;
  std::vector<Sent> events_;
};

}  // namespace cairn::test
