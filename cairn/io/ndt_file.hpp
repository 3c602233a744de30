#pragma once

#include "cairn/maps/ndt_map.hpp"

#include <filesystem>
#include <istream>
#include <memory>
#include <ostream>
#include <string>

namespace cairn {

/// NDT maps as text, SI units, numbers to the last bit:
///   cairn-ndt 1                     what it is, and the version of this layout
///   cell_size_m 0.5
///   origin x y yaw                  T_map_ndt
///   size columns rows               of each of the four layers
///   cells n
///   index points mean_x mean_y xx xy yy occupancy       n lines, in the order of their indices
void write_ndt(std::ostream& output, const NdtMap& map);

/// @throws InputError file:line:column for another version, a line that is not as above, or what NdtMap
/// refuses
std::shared_ptr<const NdtMap> read_ndt(std::istream& input, const std::string& name);

/// True if these first bytes of a file are those of an NDT map.
bool looks_like_ndt(const std::string& first_bytes);

}  // namespace cairn
