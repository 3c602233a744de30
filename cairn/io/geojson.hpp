#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/maps/vector_map.hpp"

#include <istream>
#include <ostream>
#include <string>
#include <string_view>

namespace cairn {

/// Most that a GeoJSON file may hold.
inline constexpr std::size_t kMaxGeoJsonBytes = std::size_t{256} << 20;

/// A vector map as GeoJSON (RFC 7946), the format in which Cairn saves it. Coordinates are metres in the map
/// frame, not longitude and latitude (the RFC allows that by prior arrangement). LineString, MultiLineString,
/// Polygon and MultiPolygon give walls, alone or in a Feature, a FeatureCollection or a GeometryCollection;
/// the property `material` of a feature (opaque, glass, mesh, mirror) is that of its walls. Third coordinates
/// are ignored.
/// @param diagnostics  counts walls without length and geometries without walls ("Point"), which are left out
/// @throws InputError file:line:column for text that is not JSON; file (place in the document) for a document
///   of another kind, a coordinate that is no number or out of range, an unknown material, geometry
///   collections nested more than 8 deep, no wall at all, or a file beyond kMaxGeoJsonBytes
VectorMap read_geojson(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// True if a file that begins so is JSON.
bool looks_like_geojson(std::string_view first_bytes);

/// Writes a map that reads back equal: the same walls, to the bit and in the same order.
void write_geojson(std::ostream& output, const VectorMap& map);

}  // namespace cairn
