#pragma once

#include "cairn/localization/estimate.hpp"

#include <optional>
#include <string>
#include <string_view>

/// Estimates to the last bit, as exact_messages.hpp does for events.
namespace cairn::exact {

inline constexpr std::string_view kEstimate = "cairn_msgs/msg/Estimate";

/// Definition of the message: one field per number of an Estimate.
std::string estimate_schema();
std::string encode(const Estimate& estimate);
/// @throws ros::MalformedMessage if the bytes end early
Estimate decode_estimate(std::string_view bytes);

/// A field in which two estimates differ, and its two values, as exact as they need to be to differ.
struct Difference {
  std::string field;
  std::string first;
  std::string second;
};

/// The first field, in the order of the schema, whose bits differ; nullopt if none does. Two NaN of the same
/// bits are equal, 0.0 and -0.0 are not.
std::optional<Difference> first_difference(const Estimate& first, const Estimate& second);

}  // namespace cairn::exact
