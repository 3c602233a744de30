// A message of ROS 2 or of Cairn: every type is tried on the same bytes. What is taken must come back the
// same when it is written and read again.
#include "cairn/io/estimate_message.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "fuzz_target.hpp"

namespace {

using namespace cairn;

void require(bool condition) {
  if (!condition) throw std::logic_error("a message that does not come back");
}

template <class Check>
void decode(const Check& check) {
  try {
    check();
  } catch (const ros::MalformedMessage&) {  // a refusal is an answer
  }
}

void check_exact(StreamKind kind, const std::string& bytes) {
  const std::string once = exact::encode(exact::decode(kind, 0, bytes));
  require(exact::encode(exact::decode(kind, 0, once)) == once);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = fuzz::text_of(data, size);
  decode([&] {
    const auto scan = ros2::decode_laser_scan(bytes);
    require(ros2::decode_laser_scan(ros2::encode_laser_scan(scan)).scan.ranges_m.size() ==
            scan.scan.ranges_m.size());
  });
  decode([&] { require(ros2::decode_odometry(bytes).T_parent_child.has_value()); });
  decode([&] {
    const auto transforms = ros2::decode_transforms(bytes);
    require(ros2::decode_transforms(ros2::encode_transforms(transforms)).size() == transforms.size());
  });
  for (std::size_t kind = 0; kind < kStreamKinds; ++kind)
    decode([&] { check_exact(static_cast<StreamKind>(kind), bytes); });
  decode([&] {
    const Estimate estimate = exact::decode_estimate(bytes);
    require(!exact::first_difference(estimate, exact::decode_estimate(exact::encode(estimate))).has_value());
  });
  return 0;
}
