#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/maps/vector_map.hpp"

#include <istream>
#include <string>
#include <string_view>

namespace cairn {

/// A vector map as text: one wall per line, `x1,y1,x2,y2` in metres (commas or blanks), all opaque. Empty
/// lines and lines that begin with # are skipped.
/// @param diagnostics  counts walls without length, which are left out ("zero-length segment")
/// @throws InputError file:line:column for a line of another kind, a number that is not finite or beyond
///   VectorMap::kMaxCoordinate_m; file for one without a wall or with more than VectorMap::kMaxWalls
VectorMap read_vector_text(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// True if a file that begins so may be such a text: its first line of content begins with a number and holds
/// three commas, or nothing but four numbers.
bool looks_like_vector_text(std::string_view first_bytes);

}  // namespace cairn
