#include "apps/cairn/output_file.hpp"

#include "cairn/core/errors.hpp"

#include <system_error>

#include <unistd.h>

namespace cairn::app {

namespace fs = std::filesystem;

namespace {

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw ConfigurationError(folder.string(), "is no folder and cannot be made one", "choose another --out");
}

void check_writable(const fs::path& path) {
  if (access(path.c_str(), W_OK) != 0)
    throw ConfigurationError(path.string(), "may not be written to", "choose another --out");
}

}  // namespace

void prepare_output_file(const fs::path& path) {
  if (path.empty()) throw ConfigurationError("--out", "is empty", "name a file");
  if (fs::is_directory(path)) {
    throw ConfigurationError(path.string(), "is a folder", "name a file in it");
  }
  const fs::path folder = fs::absolute(path).parent_path();
  make_folder(folder);
  check_writable(fs::exists(path) ? path : folder);
}

void prepare_output_folder(const fs::path& folder) {
  if (folder.empty()) throw ConfigurationError("--out", "is empty", "name a folder");
  make_folder(folder);
  check_writable(folder);
}

}  // namespace cairn::app
