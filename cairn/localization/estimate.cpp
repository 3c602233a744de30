#include "cairn/localization/estimate.hpp"

namespace cairn {

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kUsed:
      return "used";
    case Outcome::kNotNeeded:
      return "not_needed";
    case Outcome::kDroppedOutOfOrder:
      return "dropped_out_of_order";
    case Outcome::kDroppedNoOdometry:
      return "dropped_no_odometry";
    case Outcome::kDroppedMalformed:
      return "dropped_malformed";
    case Outcome::kDroppedUnboundStream:
      return "dropped_unbound_stream";
    case Outcome::kPending:
      return "pending";
  }
  return "unknown";
}

}  // namespace cairn
