#pragma once

#include <filesystem>

namespace cairn::app {

/// Makes ready for a file to be written to `path` once long work is done: makes the folders that are missing.
/// Throws ConfigurationError if `path` is empty or a folder, or if a file cannot be made or replaced there.
void prepare_output_file(const std::filesystem::path& path);

/// Makes the folder that a command writes several files into, before its long work.
/// Throws ConfigurationError if it cannot be made, or may not be written to.
void prepare_output_folder(const std::filesystem::path& folder);

}  // namespace cairn::app
