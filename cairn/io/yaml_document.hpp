#pragma once

#include <cstddef>
#include <istream>
#include <string>

#include <yaml-cpp/yaml.h>

namespace cairn {

/// Limits of a YAML text. Private to cairn/io (needs yaml-cpp).
inline constexpr std::size_t kMaxYamlBytes = std::size_t{1} << 20;
inline constexpr int kMaxYamlDepth = 100;

/// Parses one YAML document; a null node for an empty text or one of comments only. Aliases share their
/// anchor's node, so that they cost nothing.
/// @throws YAML::Exception with its place for what is no YAML, for more than kMaxYamlBytes, for lists and
///   mappings more than kMaxYamlDepth deep, and for a second document
YAML::Node load_yaml(const std::string& text);
YAML::Node load_yaml(std::istream& input);

}  // namespace cairn
