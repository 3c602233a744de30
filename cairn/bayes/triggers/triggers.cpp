#include "cairn/bayes/triggers/triggers.hpp"

#include "cairn/bayes/triggers/ess_ratio.hpp"
#include "cairn/bayes/triggers/every_n_updates.hpp"
#include "cairn/bayes/triggers/fixed_rate.hpp"
#include "cairn/bayes/triggers/motion_thresholds.hpp"
#include "cairn/core/errors.hpp"

namespace cairn {

const std::vector<std::string>& trigger_names() {
  static const std::vector<std::string> kNames = {"ess", "motion", "updates", "rate"};
  return kNames;
}

void TriggerOptions::visit(OptionVisitor& v) {
  v.choice(
      {"when",
       "ess: the effective share of the particles is low; motion: the robot has moved; updates: every n; "
       "rate: at most so often"},
      when, trigger_names());
  v.number({"ess_ratio", "ess: when the effective share is below this (recipe kld_mcl: below 1, always)"},
           ess_ratio, {0.0, 1.0});
  v.number({"min_translation_m", "motion: after this much driving, metres"}, min_translation_m, {0.0, 100.0});
  v.number({"min_rotation_rad", "motion: or after this much turning, radians"}, min_rotation_rad, {0.0, 7.0});
  v.integer({"every_n", "updates: at every n-th"}, every_n, {1, 1'000'000});
  v.number({"rate_hz", "rate: once per period, hertz"}, rate_hz, {1e-3, 1e4});
}

std::unique_ptr<const Trigger> make_trigger(const TriggerOptions& options) {
  if (options.when == "ess") return std::make_unique<const EssRatio>(options.ess_ratio);
  if (options.when == "motion")
    return std::make_unique<const MotionThresholds>(options.min_translation_m, options.min_rotation_rad);
  if (options.when == "updates") return std::make_unique<const EveryNUpdates>(options.every_n);
  if (options.when == "rate") return std::make_unique<const FixedRate>(options.rate_hz);
  throw ConfigurationError("when", "'" + options.when + "' is no trigger",
                           "use ess, motion, updates or rate");
}

}  // namespace cairn
