#include "cairn/io/dxf.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    cairn::Diagnostics diagnostics;
    // Coarse chords: what is looked for is in the reader, not in drawing a million of them.
    cairn::read_dxf(input, "fuzz", {.layers = {}, .unit_m = 0.0, .chord_tolerance_m = 1.0}, diagnostics);
  });
}
