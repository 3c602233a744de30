#include "cairn/io/wean_map.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size,
                                  [](std::istream& input) { cairn::read_wean_map(input, "fuzz"); });
}
