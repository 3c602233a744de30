#include "cairn/core/errors.hpp"
#include "cairn/io/mrpt_text_log.hpp"

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

// Whatever the bytes are: a log, or an InputError.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream input(std::string(reinterpret_cast<const char*>(data), size));
  try {
    cairn::read_mrpt_text_log(input, "fuzz");
  } catch (const cairn::InputError&) {
  }
  return 0;
}
