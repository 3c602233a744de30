#include "cairn/io/rosbag2_db3.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(
      data, size, [](std::istream& input) { cairn::fuzz::check(cairn::read_rosbag2_db3(input, "fuzz")); });
}
