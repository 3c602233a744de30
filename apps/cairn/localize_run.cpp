#include "apps/cairn/localize_run.hpp"

#include "cairn/localization/monitor.hpp"
#include "cairn/localization/odometry_track.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr std::size_t kSnapshots = 200;
constexpr std::size_t kParticlesPerSnapshot = 200;

// The belief counts as lost at the end of a run when, over the last scans, the map explains too few beams, or
// the particles are too wide or too divided to be of use.
constexpr std::size_t kLastScans = 20;
// Right runs on seven real logs end with 0.78 to 1.00, runs in the map of another office with 0.29 to 0.64.
constexpr double kLeastQuality = 0.7;
constexpr double kLargestSpread_m = 1.0;
constexpr double kLeastWeight = 0.5;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double spread_m(const Estimate& estimate) {
  return std::sqrt(estimate.covariance(0, 0) + estimate.covariance(1, 1));
}

// Takes snapshots that divide the time span of the log evenly.
class SnapshotTaker {
 public:
  SnapshotTaker(const Log& log, std::vector<ParticleSnapshot>& out) : out_(out) {
    if (log.events.empty()) return;
    next_ = log.events.front().stamp;
    interval_ = (log.events.back().stamp - next_) / kSnapshots;
  }

  void look(const Localizer& localizer) {
    const auto estimate = localizer.estimate();
    if (!estimate || estimate->stamp < next_) return;
    out_.push_back(localizer.snapshot(kParticlesPerSnapshot));
    while (next_ <= estimate->stamp && interval_.count() > 0) next_ += interval_;
  }

 private:
  std::vector<ParticleSnapshot>& out_;
  Time next_;
  Duration interval_{};
};

// Tells the estimate that a robot would act on now, as often as it is of a later moment than the last one, or
// of one before the clock was set back.
class CurrentEstimates {
 public:
  explicit CurrentEstimates(std::function<void(const Estimate&)> tell) : tell_(std::move(tell)) {}

  void look(const Localizer& localizer) {
    const auto estimate = localizer.estimate();
    if (!estimate) return;
    const bool old = newest_ && estimate->stamp <= *newest_;
    if (old && *newest_ - estimate->stamp < OdometryTrack::kLargestJump) return;
    newest_ = estimate->stamp;
    tell_(*estimate);
  }

 private:
  std::function<void(const Estimate&)> tell_;
  std::optional<Time> newest_;
};

MapLibrary library_of(const LocalizeRequest& request) {
  MapLibrary library = request.maps ? MapLibrary(request.maps) : MapLibrary(request.map);
  for (const auto& [name, map] : request.stream_maps) library.add(name, std::make_shared<const MapSet>(map));
  return library;
}

// The last scans, each once, however many moments its belief was carried on to.
std::vector<Estimate> last_scans(const std::vector<Estimate>& estimates) {
  std::vector<Estimate> scans;
  std::optional<Time> belief;
  for (std::size_t i = estimates.size(); i-- > 0 && scans.size() < kLastScans;) {
    if (belief == estimates[i].belief_stamp) continue;
    belief = estimates[i].belief_stamp;
    scans.push_back(estimates[i]);
  }
  return scans;
}

bool is_mostly_lost(const std::vector<Estimate>& scans) {
  const auto lost = std::count_if(scans.begin(), scans.end(), [](const Estimate& e) {
    return e.judgement.state == TrackingState::kLost;
  });
  return 2 * lost > static_cast<std::ptrdiff_t>(scans.size());
}

}  // namespace

LocalizeResult localize(const LocalizeRequest& request) {
  LocalizeResult result;
  const auto prepare_started = Clock::now();
  const auto executor = std::make_shared<const Executor>(request.threads);
  MonteCarloLocalizer localizer(request.options, request.log->streams, library_of(request), request.start,
                                request.seed, executor, nullptr, request.places);
  const auto tell = [&](const Estimate& estimate) {
    result.estimates.push_back(estimate);
    result.hypotheses.push_back(localizer.hypotheses());
    request.on_estimate(estimate);
  };
  CurrentEstimates current(tell);
  if (!request.live) localizer.set_observer(tell);
  result.prepare_s = seconds_since(prepare_started);

  const auto run_started = Clock::now();
  SnapshotTaker snapshots(*request.log, result.snapshots);
  std::int64_t done = 0;
  for (const Event& event : request.log->events) {
    request.on_event(event);
    localizer.process(event);
    if (request.live) current.look(localizer);
    snapshots.look(localizer);
    if (!request.go_on(++done)) {
      result.interrupted = true;
      break;
    }
  }
  localizer.finish();
  result.run_s = seconds_since(run_started);
  result.outcomes = localizer.outcomes();
  result.diagnostics = localizer.diagnostics();
  result.updates = localizer.updates();
  return result;
}

EndVerdict judge_end(const std::vector<Estimate>& estimates) {
  if (estimates.empty()) return {true, "no scan could be used"};
  const std::vector<Estimate> scans = last_scans(estimates);
  const std::size_t count = scans.size();
  double quality = 0.0;
  for (const Estimate& scan : scans) quality += scan.quality / static_cast<double>(count);
  const Estimate& last = estimates.back();
  if (is_mostly_lost(scans)) return {true, explain(last.judgement)};
  if (quality < kLeastQuality) {
    return {true,
            fmt::format("the map explains only {:.0f} % of the beams of the last {} scans: the robot is "
                        "elsewhere, or map and log do not belong together",
                        100 * quality, count)};
  }
  if (spread_m(last) > kLargestSpread_m) {
    return {true, fmt::format("the position is known to {:.1f} m only", spread_m(last))};
  }
  if (last.weight < kLeastWeight) {
    return {true, fmt::format("{} places fit about equally well", last.hypotheses)};
  }
  return {false,
          fmt::format("the map explains {:.0f} % of the beams of the last {} scans", 100 * quality, count)};
}

}  // namespace cairn::app
