#include "cairn/localization/monitor.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kSureOfStart = 3.0;  // log-odds of a start pose that was given
constexpr double kWon = 2.0;          // of a place that has won against all others
constexpr double kMissing = 0.5;      // an open place has no returns either
constexpr double kMostOdds = 8.0;     // a long good time must not make blind
constexpr double kBlockedMemory = 0.7;
constexpr double kTrusted = 2.0;         // log-odds above which a scan counts as usual
constexpr double kUsualMemory = 0.9;     // of what a scanner says against poses that others vouch for
constexpr double kNotableDrift_m = 0.5;  // that a reason names
constexpr double kMisfit = -0.5;         // log-odds: so much against them, and its map does not fit it
// Without classes of beams: what an explained share says.
constexpr double kQualitySlope = 4.0;
constexpr double kEvenQuality = 0.55;

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }
double log_odds(double p) { return std::log(p / (1.0 - p)); }

// Of right poses 99.9 % drift by less than half a metre on seven recordings, by less than 0.82 m in Wean
// Hall.
double agreement(double drift_m, double halved_at_m) {
  return halved_at_m > 0.0 ? 1.0 / (1.0 + std::pow(drift_m / halved_at_m, 6.0)) : 1.0;
}

double entropy_of(std::span<const Hypothesis> places) {
  double sum = 0.0;
  for (const Hypothesis& place : places) {
    if (place.weight > 0.0) sum -= place.weight * std::log(place.weight);
  }
  return sum;
}

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

std::string ambiguity_of(const Judgement& j) {
  if (j.drift > kNotableDrift_m)
    return "the map has drawn the pose " + std::to_string(j.drift).substr(0, 4) +
           " m away from the robot's own motion";
  return "several places fit, or one is too wide (entropy " + std::to_string(j.entropy).substr(0, 4) +
         " nat)";
}

}  // namespace

void MonitorOptions::visit(OptionVisitor& v) {
  const Range any{-1e3, 1e3};
  const Range share{0.0, 1.0};
  v.number({"bias", "log-odds that a scan of zero figures gives the pose"}, bias, any);
  v.number({"explained", "per share of beams that the map explains"}, explained, any);
  v.number({"blocked", "per share of beams that end before the expected wall"}, blocked, any);
  v.number({"beyond", "per share of beams that pass through a wall"}, beyond, any);
  v.number({"fit", "per nat of the log-likelihood per beam"}, fit, any);
  v.number({"drop", "per share by which fewer beams are explained than usual"}, drop, any);
  v.number({"innovation", "per metre that the measurement moved the pose, up to 1"}, innovation, any);
  v.number({"largest", "one scan never adds more log-odds than this"}, largest, {0.0, 100.0});
  v.number({"lost_rate", "prior probability of being carried away between two updates"}, lost_rate, share);
  v.number({"found_rate", "likewise of a lost filter coming right by itself"}, found_rate, share);
  v.number({"scale", "of the reported log-odds"}, scale, {0.0, 100.0});
  v.number(
      {"drift_m",
       "the probability is halved where the pose has left the robot's own motion by this, metres; 0: never"},
      drift_m, {0.0, 1e6});
  v.number({"usual_memory", "share of the usual figures that outlives an update"}, usual_memory, share);
  v.number({"crowded_share", "state crowded above this share of blocked beams"}, crowded_share, share);
  v.number({"ambiguous_weight", "state ambiguous below this weight of the heaviest place"}, ambiguous_weight,
           share);
  v.number({"ambiguous_m", "or above this standard deviation of the position, metres"}, ambiguous_m,
           {0.0, 1e6});
  v.integer({"blind_scans", "state sensor_fault after so many scans without a usable beam"}, blind_scans,
            {1, 1'000'000});
}

MonitorMemory Monitor::begin(std::size_t streams, bool anywhere) {
  MonitorMemory memory;
  memory.streams.resize(streams);
  memory.log_odds = anywhere ? 0.0 : kSureOfStart;
  return memory;
}

double Monitor::right(const MonitorMemory& memory) const {
  return right_by_scans(memory) * agreement(memory.drift_m, options_.drift_m);
}

double Monitor::right_by_scans(const MonitorMemory& memory) const {
  return logistic(options_.scale * memory.log_odds);
}

void Monitor::start_over(MonitorMemory& memory) {
  memory.log_odds = 0.0;
  memory.drift_m = 0.0;
}

void Monitor::take_over(MonitorMemory& memory) {
  memory.log_odds = kWon;
  memory.drift_m = 0.0;
}

double Monitor::evidence(const MonitorInput& input, double usual) const {
  if (!input.seen) return kQualitySlope * (input.quality - kEvenQuality);
  const BeamShares& s = *input.seen;
  const double sum = options_.bias + options_.explained * s.explained + options_.blocked * s.blocked +
                     options_.beyond * s.beyond + options_.fit * s.fit +
                     options_.drop * std::max(0.0, usual - s.explained) +
                     options_.innovation * std::min(1.0, input.innovation_m);
  return input.share * std::clamp(sum, -options_.largest, options_.largest);
}

// What a scanner says against poses that others vouch for, it says for want of a map that fits it; so does
// one that is known for that.
double Monitor::counted(double evidence, bool vouched, MonitorMemory::Stream& stream) const {
  if (vouched)
    stream.usually_against += (1.0 - kUsualMemory) * (std::min(0.0, evidence) - stream.usually_against);
  return vouched || stream.usually_against <= kMisfit ? std::max(0.0, evidence) : evidence;
}

Judgement Monitor::update(MonitorMemory& memory, const MonitorInput& input) const {
  MonitorMemory::Stream& stream = memory.streams[input.stream];
  memory.drift_m = input.drift_m;
  const bool blind = input.seen && input.seen->beams == 0;
  stream.blind = blind && input.seen->missing > kMissing ? stream.blind + 1 : 0;
  if (!blind) {
    const double right = logistic(memory.log_odds);
    const double still = right * (1.0 - options_.lost_rate) + (1.0 - right) * options_.found_rate;
    const double explained = input.seen ? input.seen->explained : input.quality;
    const double usual = stream.usual_explained < 0.0 ? explained : stream.usual_explained;
    memory.last_evidence = evidence(input, usual);
    memory.log_odds = std::clamp(log_odds(still) + counted(memory.last_evidence, input.vouched, stream),
                                 -kMostOdds, kMostOdds);
    if (memory.log_odds > kTrusted)
      stream.usual_explained = options_.usual_memory * usual + (1.0 - options_.usual_memory) * explained;
    const double blocked = input.seen ? input.seen->blocked : 0.0;
    memory.blocked = kBlockedMemory * memory.blocked + (1.0 - kBlockedMemory) * blocked;
  }
  Judgement judgement;
  judgement.entropy = entropy_of(input.places);
  judgement.innovation = input.innovation_m;
  judgement.drift = input.drift_m;
  if (input.seen) describe(*input.seen, judgement);
  const double weight = input.places.empty() ? 1.0 : input.places.front().weight;
  judgement.probability = weight * right(memory);
  judgement.state = state(memory, input);
  return judgement;
}

bool Monitor::fits(const MonitorMemory& memory, StreamId stream) {
  return memory.streams[stream].usually_against > kMisfit;
}

void Monitor::believe(MonitorMemory& memory, StreamId stream) {
  memory.streams[stream].usually_against = 0.0;
}

void Monitor::describe(const BeamShares& seen, Judgement& judgement) {
  judgement.explained = seen.explained;
  judgement.blocked = seen.blocked;
  judgement.beyond = seen.beyond;
  judgement.fit = seen.fit;
}

TrackingState Monitor::state(const MonitorMemory& memory, const MonitorInput& input) const {
  const auto& stream = memory.streams[input.stream];
  if (stream.blind >= options_.blind_scans) return TrackingState::kSensorFault;
  if (memory.log_odds < 0.0) return TrackingState::kLost;
  if (right(memory) < 0.5) return TrackingState::kAmbiguous;
  if (!input.places.empty()) {
    const Hypothesis& heaviest = input.places.front();
    const double spread_m = std::sqrt(heaviest.covariance(0, 0) + heaviest.covariance(1, 1));
    if (heaviest.weight < options_.ambiguous_weight || spread_m > options_.ambiguous_m)
      return TrackingState::kAmbiguous;
  }
  return memory.blocked > options_.crowded_share ? TrackingState::kCrowded : TrackingState::kTracking;
}

std::string explain(const Judgement& j) {
  std::string seen = "the map explains " + percent(j.explained) + " of the beams, " + percent(j.blocked) +
                     " end at something unknown in front of its walls, " + percent(j.beyond) +
                     " pass through them";
  switch (j.state) {
    case TrackingState::kTracking:
      return seen;
    case TrackingState::kCrowded:
      return "much is in the way, but nothing speaks against the pose: " + seen;
    case TrackingState::kAmbiguous:
      return ambiguity_of(j) + "; the heaviest is right with a probability of " + percent(j.probability);
    case TrackingState::kLost:
      return "the pose is right with a probability of " + percent(j.probability) + " only: " + seen;
    case TrackingState::kSensorFault:
      return "the last scans have no usable beam";
  }
  return seen;
}

}  // namespace cairn
