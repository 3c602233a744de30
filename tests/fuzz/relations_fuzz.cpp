#include "cairn/io/relations.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cairn::fuzz::read_stream(data, size, [](std::istream& input) {
    if (cairn::read_relations(input, "fuzz").empty()) throw std::logic_error("no relation and no error");
  });
}
