#pragma once

#include "cairn/maps/occupancy_grid.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Map of the Wean Hall recordings (CMU, BeeSoft): `robot_specifications->resolution CM` and sizes in cm,
/// `global_map[0]: NX NY`, then NX lines of NY values, the line being x and the value's place y. A value is
/// the probability that the cell is *free*, -1 where unknown. Cell (0, 0) has its outer corner at the map's
/// origin.
/// @throws InputError file:line:column for a malformed header, sizes that the file does not hold, a value
///   that is neither -1 nor within 0..1, and surplus values
OccupancyGrid read_wean_map(std::istream& input, const std::string& name);

/// True if a file that begins so is a Wean map.
bool looks_like_wean_map(const std::string& first_bytes);

}  // namespace cairn
