#pragma once

#include "cairn/sensing/event.hpp"

namespace cairn {

/// What makes an event unusable whatever the map, or nullptr if it can be used:
/// - its stamp is not that of its payload; its stamp or its arrival is more than 146 years from zero
///   (differences would overflow)
/// - an odometry pose that is not finite or more than 100 000 km from zero
/// - a scan that is missing, has no beam, has neither a valid range nor a beam that went beyond reach, or
///   whose angles are not finite, do not advance, or sweep more than two turns
/// - any other measurement that is missing, or has a defect_of() (sensing/defect.hpp)
const char* defect(const Event& event);

}  // namespace cairn
