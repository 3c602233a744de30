#pragma once

#include "cairn/bayes/triggers/trigger.hpp"
#include "cairn/core/options.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// A trigger by name, with its parameter. Parameters of the other triggers do nothing.
struct TriggerOptions {
  std::string when = "ess";        ///< one of trigger_names()
  double ess_ratio = 0.5;          ///< of EssRatio
  double min_translation_m = 0.1;  ///< of MotionThresholds
  double min_rotation_rad = 0.1;   ///< likewise
  int every_n = 1;                 ///< of EveryNUpdates
  double rate_hz = 5.0;            ///< of FixedRate

  void visit(OptionVisitor& visitor);
};

/// ess, motion, updates, rate.
const std::vector<std::string>& trigger_names();

/// @throws ConfigurationError for an unknown name
std::unique_ptr<const Trigger> make_trigger(const TriggerOptions& options);

}  // namespace cairn
