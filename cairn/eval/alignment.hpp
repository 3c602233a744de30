#pragma once

#include "cairn/eval/association.hpp"

#include <span>
#include <string_view>

namespace cairn {

/// How the estimate's frame is brought onto the reference's before errors are taken.
enum class Alignment {
  kNone,   ///< both are in the same map: errors include a wrong map-to-map transform
  kRigid,  ///< one SE(2) transform for the whole run, least squares on the positions
};

const char* to_string(Alignment alignment);

/// "none" or "rigid". @throws ConfigurationError for anything else.
Alignment alignment_from_string(std::string_view name);

/// The T that minimises sum |p_reference - T p_estimate|^2: closed form of Umeyama (1991) in the plane,
/// without scale. Headings play no part. Where positions do not determine the turn (fewer than two pairs, or
/// all estimates in one point) it is 0. Identity for no pairs.
Pose2 rigid_alignment(std::span<const PosePair> pairs);

/// Every estimate moved into the reference's frame: T_reference_estimate * estimate.
std::vector<PosePair> aligned(std::span<const PosePair> pairs, const Pose2& T_reference_estimate);

}  // namespace cairn
