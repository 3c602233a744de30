#pragma once

#include "apps/cairn/commands.hpp"
#include "cairn/maps/vector_map.hpp"

#include <string>

namespace cairn::app {

/// `cairn map convert`: grid to vector map and back, and between the formats of either.
void add_map_convert(CLI::App& parent, Runner& run);

/// What `cairn map info` says of a vector map, as text or JSON.
std::string describe(const VectorMap& map, bool as_json);

}  // namespace cairn::app
