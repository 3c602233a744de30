#pragma once

#include <filesystem>
#include <string>

namespace cairn::app {

/// Writes DIR/report.html from the other files of a run (see run_directory.hpp), replacing an older one.
/// @return empty, or why this program cannot write reports (it was built without npm): then nothing is
///   written, and the rest of the run is as good as with one
/// @throws InputError for files that are missing or damaged, and where the disk refuses
std::string write_report(const std::filesystem::path& directory);

}  // namespace cairn::app
