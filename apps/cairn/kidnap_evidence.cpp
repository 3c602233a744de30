#include "apps/cairn/kidnap_evidence.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::app {
namespace {

// One radian counts as one metre, as in recovery.
double length(const Pose2& T) { return std::hypot(T.x, T.y) + std::abs(normalize_angle(T.theta)); }

/// The true place and the believed one, from scan to scan.
class Duel {
 public:
  Duel(const Pose2& T_believed_true, const RecoveryOptions& options)
      : T_believed_true_(T_believed_true),
        rivals_({.beams = options.rival_beams, .largest = options.rival_most}),
        news_m_(options.news_m) {}

  void weigh(const StreamModel& model, const Event::Payload& z, const Pose2& truth) {
    const Pose2 step = begun_ ? inverse(truth_before_) * truth : Pose2{};
    places_ = begun_ ? std::array{places_[0] * step, places_[1] * step}
                     : std::array{truth, T_believed_true_ * truth};
    const double news = begun_ ? std::min(1.0, length(step) / news_m_) : 1.0;
    std::array<double, 2> fits{};
    if (!model.follow(z, places_, fits)) return;
    begun_ = true;
    truth_before_ = truth;
    log_odds_ += news * (rivals_.evidence(fits[0]) - rivals_.evidence(fits[1]));
  }

  std::optional<double> log_odds() const { return begun_ ? std::optional(log_odds_) : std::nullopt; }

 private:
  Pose2 T_believed_true_;  // T_map_base of the believed way = T_believed_true_ * that of the true one
  Rivals rivals_;
  double news_m_;
  bool begun_ = false;
  Pose2 truth_before_;
  std::array<Pose2, 2> places_;
  double log_odds_ = 0.0;
};

}  // namespace

std::optional<double> evidence_for_truth(std::span<const Event> events, const StreamBindings& streams,
                                         const Trajectory& reference, const BelievedWay& way,
                                         const RecoveryOptions& options) {
  const auto true_end = pose_at(reference, way.to);
  if (!true_end) return std::nullopt;
  Duel duel(way.believed_at_end * inverse(*true_end), options);
  for (const Event& event : events) {
    const auto& model = streams.models[event.stream];
    if (!model || event.stamp <= way.from || event.stamp > way.to || !model->informs(event.payload)) continue;
    if (const auto truth = pose_at(reference, event.stamp)) duel.weigh(*model, event.payload, *truth);
  }
  return duel.log_odds();
}

}  // namespace cairn::app
