#include "cairn/io/mcap_log.hpp"
#include "cairn/io/recording.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::fuzz::read_stream(data, size, [](std::istream& input) { cairn::read_recording(input, "fuzz"); });
  return cairn::fuzz::read_stream(
      data, size, [](std::istream& input) { cairn::fuzz::check(cairn::read_mcap_log(input, "fuzz")); });
}
