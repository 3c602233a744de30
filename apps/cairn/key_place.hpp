#pragma once

#include <functional>
#include <string>

namespace cairn::app {

/// Calls `work`; a ConfigurationError whose where() is a dotted key of the YAML file is thrown again with the
/// place of that key in the file.
/// @param text  of the file
void with_key_places(const std::string& name, const std::string& text, const std::function<void()>& work);

}  // namespace cairn::app
