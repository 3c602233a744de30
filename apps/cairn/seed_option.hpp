#pragma once

#include <cstdint>
#include <string>

namespace cairn::app {

/// A seed: a whole decimal number from 0 to 2^64 - 1. `option` names it in messages.
/// @throws ConfigurationError for anything else
std::uint64_t parse_seed(const std::string& option, const std::string& text);

}  // namespace cairn::app
