#include "cairn/io/estimate_message.hpp"

#include "cairn/io/cdr.hpp"
#include "cairn/io/exact_messages.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace cairn::exact {
namespace {

// Calls visit(name, value) for every number, in the order of the message.
template <class AnyEstimate, class Visit>
void for_each_field(AnyEstimate& estimate, Visit visit) {
  // A member that Estimate gains must be recorded, too: then this line no longer compiles.
  auto& [stamp, T_map_base, covariance, ess, particles, hypotheses, weight, quality, belief_stamp, T_map_odom,
         judgement] = estimate;
  auto& [state, probability, explained, blocked, beyond, fit, innovation, entropy, drift] = judgement;
  visit("stamp", stamp);
  visit("x", T_map_base.x);
  visit("y", T_map_base.y);
  visit("theta", T_map_base.theta);
  constexpr const char* kEntries[3][3] = {{"covariance_xx", "covariance_xy", "covariance_xt"},
                                          {"covariance_yx", "covariance_yy", "covariance_yt"},
                                          {"covariance_tx", "covariance_ty", "covariance_tt"}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) visit(kEntries[row][column], covariance(row, column));
  }
  visit("ess", ess);
  visit("particles", particles);
  visit("hypotheses", hypotheses);
  visit("weight", weight);
  visit("quality", quality);
  visit("belief_stamp", belief_stamp);
  visit("map_odom_x", T_map_odom.x);
  visit("map_odom_y", T_map_odom.y);
  visit("map_odom_theta", T_map_odom.theta);
  visit("state", state);
  visit("probability", probability);
  visit("explained", explained);
  visit("blocked", blocked);
  visit("beyond", beyond);
  visit("fit", fit);
  visit("innovation", innovation);
  visit("entropy", entropy);
  visit("drift", drift);
}

// How a member is written: its type in the schema, and the number that stands for it.
std::int64_t wire(Time time) { return time.time_since_epoch().count(); }
std::int32_t wire(int value) { return value; }
std::int32_t wire(TrackingState state) { return static_cast<std::int32_t>(state); }
double wire(double value) { return value; }

const char* wire_type(std::int64_t) { return "int64"; }
const char* wire_type(std::int32_t) { return "int32"; }
const char* wire_type(double) { return "float64"; }

void take(cdr::Reader& fields, Time& time) { time = Time(Duration(fields.number<std::int64_t>())); }
void take(cdr::Reader& fields, int& value) { value = fields.number<std::int32_t>(); }
void take(cdr::Reader& fields, TrackingState& state) {
  state = static_cast<TrackingState>(fields.number<std::int32_t>());
}
void take(cdr::Reader& fields, double& value) { value = fields.number<double>(); }

struct Value {
  std::string field;
  std::uint64_t bits;
  std::string text;
};

Value value_of(const char* field, Time time) {
  return {field, static_cast<std::uint64_t>(wire(time)), format_time(time)};
}
Value value_of(const char* field, int value) {
  return {field, static_cast<std::uint64_t>(value), std::to_string(value)};
}
Value value_of(const char* field, TrackingState state) {
  return {field, static_cast<std::uint64_t>(state), std::to_string(static_cast<int>(state))};
}
Value value_of(const char* field, double value) {
  return {field, std::bit_cast<std::uint64_t>(value), to_text(value)};
}

std::vector<Value> values_of(const Estimate& estimate) {
  std::vector<Value> values;
  for_each_field(estimate,
                 [&](const char* field, const auto& value) { values.push_back(value_of(field, value)); });
  return values;
}

}  // namespace

std::string estimate_schema() {
  std::string text = "# A belief of Cairn: pose in the map, covariance (t: theta), and how it was come by.\n";
  const Estimate estimate;
  for_each_field(estimate, [&](const char* field, const auto& value) {
    text.append(wire_type(wire(value))).append(" ").append(field).append("\n");
  });
  return text;
}

std::string encode(const Estimate& estimate) {
  cdr::Writer fields;
  for_each_field(estimate, [&](const char*, const auto& value) { fields.number(wire(value)); });
  return std::move(fields).bytes();
}

Estimate decode_estimate(std::string_view bytes) {
  cdr::Reader fields(bytes);
  Estimate estimate;
  for_each_field(estimate, [&](const char*, auto& value) { take(fields, value); });
  ros::require(fields.ok(), "it ends early");
  return estimate;
}

std::optional<Difference> first_difference(const Estimate& first, const Estimate& second) {
  const std::vector<Value> a = values_of(first);
  const std::vector<Value> b = values_of(second);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].bits != b[i].bits) return Difference{a[i].field, a[i].text, b[i].text};
  }
  return std::nullopt;
}

}  // namespace cairn::exact
