#pragma once

#include <string>

namespace cairn::app {

/// The path with `$CAIRN_DATA` at its beginning replaced by the environment variable.
/// @param key  that the path comes from, for the error
/// @throws ConfigurationError if the variable is needed and not set
std::string expand_data(const std::string& key, const std::string& path);

}  // namespace cairn::app
