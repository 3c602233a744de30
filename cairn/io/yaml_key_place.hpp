#pragma once

#include <string>

namespace cairn {

/// Where a dotted key stands in a YAML text: "file:line:column: inputs.office.log". A key that is not there
/// gets the place of the deepest group of its path that is; a text that is no YAML mapping, just the file's
/// name. For errors that are found only after reading: options that do not fit each other.
/// @param name  of the file
std::string yaml_key_place(const std::string& text, const std::string& name, const std::string& key);

}  // namespace cairn
