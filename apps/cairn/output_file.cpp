#include "apps/cairn/output_file.hpp"

#include "cairn/core/errors.hpp"

#include <system_error>

#include <unistd.h>

namespace cairn::app {

namespace fs = std::filesystem;

void prepare_output_file(const fs::path& path) {
  if (path.empty()) throw ConfigurationError("--out", "is empty", "name a file");
  if (fs::is_directory(path)) {
    throw ConfigurationError(path.string(), "is a folder", "name a file in it");
  }
  const fs::path folder = fs::absolute(path).parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw ConfigurationError(folder.string(), "is no folder and cannot be made one", "choose another --out");
  }
  const fs::path& written = fs::exists(path) ? path : folder;
  if (access(written.c_str(), W_OK) != 0) {
    throw ConfigurationError(written.string(), "may not be written to", "choose another --out");
  }
}

}  // namespace cairn::app
