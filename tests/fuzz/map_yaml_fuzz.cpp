#include "cairn/io/map_yaml.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    cairn::Diagnostics diagnostics;
    const cairn::MapDescription map = cairn::read_map_description(input, "fuzz", diagnostics);
    const cairn::GrayImage image{3, 1, {0, 205, 254}, {}};
    cairn::to_grid(image, map);
  });
}
