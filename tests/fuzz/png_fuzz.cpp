#include "cairn/io/png.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    const cairn::GrayImage image = cairn::read_png(cairn::read_rest(input), "fuzz");
    if (image.gray.size() != image.size()) throw std::logic_error("pixels and size do not fit");
    if (!image.opacity.empty() && image.opacity.size() != image.size()) throw std::logic_error("opacity");
  });
}
