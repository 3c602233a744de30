#pragma once

#include <cstdlib>
#include <filesystem>

namespace cairn::test {

/// Folder of the real recordings: $CAIRN_DATA, else ../shared/data beside the checkout.
inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("CAIRN_DATA")) return folder;
  return std::filesystem::path(CAIRN_SOURCE_DIR).parent_path() / "shared" / "data";
}

/// A recording, or an empty path where this machine has it not: then skip the test with CAIRN_SKIP_WITHOUT.
inline std::filesystem::path data_file(const std::filesystem::path& relative) {
  const std::filesystem::path path = data_folder() / relative;
  return std::filesystem::exists(path) ? path : std::filesystem::path();
}

}  // namespace cairn::test

#define CAIRN_SKIP_WITHOUT(relative)                                                        \
  if (cairn::test::data_file(relative).empty()) {                                           \
    GTEST_SKIP() << "no recording " << relative << " under " << cairn::test::data_folder(); \
  }
