#pragma once

#include "cairn/core/errors.hpp"
#include "cairn/io/log.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

/// Every fuzz target is a file `<reader>_fuzz.cpp` that defines this function, and nothing else with a public
/// name. libFuzzer calls it with inputs of its own making; the crash regression test with the files kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace cairn::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(data), size);
}

/// Gives the bytes to `read(std::istream&)`. A refusal (InputError, ConfigurationError) is an answer; any
/// other exception is a bug and goes through.
template <class Read>
int read_stream(const std::uint8_t* data, std::size_t size, Read read) {
  std::istringstream input(text_of(data, size));
  try {
    read(input);
  } catch (const InputError& error) {
    if (std::strlen(error.what()) == 0) throw std::logic_error("an error that says nothing");
  }
  return 0;
}

/// What holds for every log, however bad the file was.
inline void check(const Log& log) {
  for (const Event& event : log.events) {
    if (kind_of(event) != log.streams.at(event.stream).kind)
      throw std::logic_error("an event of another kind");
    if (!visit_payload(event, [](const auto&) {})) throw std::logic_error("an event that says nothing");
    const auto* odometry = std::get_if<Odometry>(&event.payload);
    if (odometry != nullptr && !is_finite(odometry->T_odom_base))
      throw std::logic_error("a pose that is not finite");
  }
}

}  // namespace cairn::fuzz
