#pragma once

#include "cairn/sim/world.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::app {

/// True for a name that `cairn simulate` knows without a file.
bool is_built_in_world(const std::string& name);

/// The text of a world file.
/// @throws ConfigurationError if there is no such file; InputError as open_input
std::string read_world_text(const std::string& path);

/// Reads the world that a name or a file tells, with settings (`key=value`) over it. A file begins with what
/// its `built_in` names; the presets come over that, then its own keys. Its files lie beside it, or below
/// `$CAIRN_DATA`.
/// @throws ConfigurationError file:line:column: key; InputError for files that cannot be read
WorldOptions read_world_options(const std::string& world, const std::vector<std::string>& settings,
                                std::uint64_t seed);

/// The world file and all that it names: floor, presets, path and its log. None for a built-in world.
std::vector<std::string> files_of_world(const std::string& world);

/// The same, built and checked. Errors of keys that come from the file name their line.
World read_world(const std::string& world, const std::vector<std::string>& settings, std::uint64_t seed);

}  // namespace cairn::app
