#include "apps/cairn/seed_option.hpp"

#include "cairn/core/errors.hpp"

#include <charconv>

namespace cairn::app {

std::uint64_t parse_seed(const std::string& option, const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, seed);
  if (result.ec != std::errc() || result.ptr != end) {
    throw ConfigurationError(option, "'" + text + "' is no seed",
                             "give a whole number from 0 to 18446744073709551615");
  }
  return seed;
}

}  // namespace cairn::app
