#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/maps/vector_map.hpp"

#include <istream>
#include <map>
#include <string>
#include <string_view>

namespace cairn {

struct DxfOptions {
  /// Material of the walls on a layer. A layer that is not named here is of glass, mesh or mirror if its name
  /// contains that word, in any case; else opaque.
  std::map<std::string, Material> layers = {};
  /// Metres per unit of the drawing; 0: as $INSUNITS says, metres where the drawing does not say.
  double unit_m = 0.0;
  /// Arcs become chords that stay this close to them, metres.
  double chord_tolerance_m = 0.005;
};

/// Reads a vector map from a drawing (ASCII DXF, R12 to 2018): LINE, LWPOLYLINE and POLYLINE with bulges,
/// ARC, CIRCLE, and INSERT of blocks, nested, scaled, turned, mirrored and in rows and columns. What lies on
/// layer 0 of a block is on the layer of the insertion. Drawings are seen from above; entities in paper space
/// and those of other kinds are left out.
/// @param diagnostics  counts what was left out: other entities by their kind, "paper space", walls without
///   length ("zero-length segment"), and "no unit in the drawing" where metres are assumed
/// @throws InputError file:line for text that is no DXF, a value of another kind, a coordinate out of range,
///   the insertion of an unknown block, blocks nested more than 16 deep (also in a circle), and more than
///   VectorMap::kMaxWalls walls or 10^6 insertions; file if there is no wall or the drawing is binary;
///   ConfigurationError for options out of range
VectorMap read_dxf(std::istream& input, const std::string& name, const DxfOptions& options,
                   Diagnostics& diagnostics);

/// True if a file that begins so is a DXF drawing (ASCII, or binary, which read_dxf refuses).
bool looks_like_dxf(std::string_view first_bytes);

}  // namespace cairn
