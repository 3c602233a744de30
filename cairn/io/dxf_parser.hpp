#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/io/dxf_entities.hpp"

#include <istream>
#include <map>
#include <string>
#include <vector>

namespace cairn {

/// A drawing as the file tells it: nothing inserted or scaled yet.
struct DxfDrawing {
  DxfBlock model;                          ///< the entities of the drawing itself
  std::map<std::string, DxfBlock> blocks;  ///< by name
  std::vector<std::string> layers;         ///< names; the first is "0"
  long long insert_units = 0;              ///< $INSUNITS; 0: not told
};

/// Reads the groups of an ASCII DXF file. What it leaves out is counted in `diagnostics`.
/// @throws InputError file:line as read_dxf
DxfDrawing parse_dxf(std::istream& input, const std::string& name, Diagnostics& diagnostics);

}  // namespace cairn
