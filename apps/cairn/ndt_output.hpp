#pragma once

#include "cairn/maps/ndt_map.hpp"

#include <string>

namespace cairn::app {

/// Writes an NDT map and says so. @throws InputError if it cannot be written
void write_ndt_map(const std::string& path, const NdtMap& map);

/// What `cairn map info` says of an NDT map, as text or JSON.
std::string describe(const NdtMap& map, bool as_json);

}  // namespace cairn::app
