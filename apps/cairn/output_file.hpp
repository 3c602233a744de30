#pragma once

#include <filesystem>

namespace cairn::app {

/// Makes ready for a file to be written to `path` once long work is done: makes the folders that are missing.
/// Throws ConfigurationError if `path` is empty or a folder, or if a file cannot be made or replaced there.
void prepare_output_file(const std::filesystem::path& path);

}  // namespace cairn::app
