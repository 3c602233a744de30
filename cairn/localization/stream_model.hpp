#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/localization/cost_clock.hpp"
#include "cairn/models/search/one_shot.hpp"
#include "cairn/models/sensor/beam_classes.hpp"
#include "cairn/sensing/event.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cairn {

/// A measurement of a short while ago, and where the robot was then as seen from where it is now.
struct Glimpse {
  Event::Payload z;
  Pose2 T_now_then;
};

/// What one stream's measurements tell of the pose: its sensor model, mounting pose and map, bound together.
/// The run-time around the filter knows no more of a sensor than this. Immutable.
class StreamModel {
 public:
  virtual ~StreamModel() = default;

  /// The only kind of measurement that the functions below may be given.
  virtual StreamKind kind() const { return StreamKind::kLaserScan; }

  /// The measurement as a function of poses T_map_base alone. @param compact false while the belief is spread
  /// over several places: the likelihood has then to be as wide as the gaps between the particles
  virtual BoundUpdate<Pose2> bind(const Event::Payload& z, bool compact) const = 0;

  /// Draws up to so many poses from the belief.
  using BeliefSample = std::function<std::vector<Pose2>(std::size_t at_most)>;
  /// Likewise as a belief reads it that can be drawn from: without what fits nowhere in it, for example. By
  /// default it is read in the same way whatever is believed.
  virtual BoundUpdate<Pose2> bind_given(const Event::Payload& z, bool compact,
                                        const BeliefSample& /*belief*/) const {
    return bind(z, compact);
  }

  /// False if the measurement is as likely in every pose: a scan of an open place, all beams without return,
  /// for a model that looks at end points.
  virtual bool informs(const Event::Payload& z) const = 0;

  /// Where the robot may be that measured these on its way, the newest last, whatever was believed before:
  /// the poses T_map_base that were asked for among them, where they fit. None: this sensor cannot tell.
  virtual std::vector<LocatedPose> locate(std::span<const Glimpse> /*way*/,
                                          std::span<const Pose2> /*asked*/) const {
    return {};
  }

  /// Where a robot that was lost may be now, T_map_base. nullopt: this sensor cannot tell.
  virtual std::optional<std::vector<LocatedPose>> search(std::span<const Glimpse> /*glimpses*/) const {
    return std::nullopt;
  }

  /// Moves each place T_map_base to where the measurement fits best nearby (within a few decimetres), and
  /// tells how well: log-likelihood per beam, comparable between places for one measurement. False, and
  /// nothing changed: this sensor cannot tell. @pre as many places as fits
  virtual bool follow(const Event::Payload& /*z*/, std::span<Pose2> /*places*/,
                      std::span<double> /*fits*/) const {
    return false;
  }

  /// Share of the measurement that the map explains, seen from `T_map_base`: 0..1.
  virtual double explained_share(const Event::Payload& z, const Pose2& T_map_base) const = 0;

  /// How the beams stand to the map, seen from there; nullopt: this sensor has none.
  virtual std::optional<BeamShares> classify(const Event::Payload& /*z*/, const Pose2& /*T_map_base*/) const {
    return std::nullopt;
  }

  /// Whether continued_share() may ever tell.
  virtual bool can_continue() const { return false; }
  /// Likewise of this measurement.
  virtual bool can_continue(const Event::Payload& /*z*/) const { return can_continue(); }

  /// Share of a measurement that is where the one before leads to expect it, whatever the map says. nullopt:
  /// they are too far apart. @param T_before_now motion of the base in between
  virtual std::optional<double> continued_share(const Event::Payload& /*before*/,
                                                const Event::Payload& /*now*/,
                                                const Pose2& /*T_before_now*/) const {
    return std::nullopt;
  }

  /// Whether closeness() may tell of this measurement.
  virtual bool can_compare(const Event::Payload& /*z*/) const { return false; }
  /// How closely two measurements agree if the robot has moved so: 0..1, to compare motions by. nullopt: they
  /// are too far apart. @param T_before_now motion of the base in between
  virtual std::optional<double> closeness(const Event::Payload& /*before*/, const Event::Payload& /*now*/,
                                          const Pose2& /*T_before_now*/) const {
    return std::nullopt;
  }

  /// Evaluated parts of the measurement, weighted by what one of them costs (UpdateWork::beams).
  virtual double beams(const Event::Payload& z) const = 0;
};

}  // namespace cairn
