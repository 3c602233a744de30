#pragma once

#include <string>

namespace cairn::app {

/// True for a name that `cairn simulate` knows without a file.
bool is_built_in_world(const std::string& name);

}  // namespace cairn::app
