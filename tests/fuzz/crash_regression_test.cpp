// Runs the inputs kept from fuzzing through the fuzz targets, without a fuzzer: corpus/<reader>/ (seeds) and
// crashes/<reader>/ (what once crashed, hung, or ate memory).
#include "fuzz_targets.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string content(const fs::path& file) {
  std::ifstream input(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
}

class FuzzTarget : public testing::TestWithParam<cairn::fuzz::Target> {
 protected:
  static void run_all(const fs::path& folder) {
    for (const fs::path& file : files_in(folder / GetParam().reader)) {
      SCOPED_TRACE(file);
      const std::string bytes = content(file);
      EXPECT_NO_THROW(GetParam().run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    }
  }
  const fs::path here = fs::path(CAIRN_SOURCE_DIR) / "tests" / "fuzz";
};

INSTANTIATE_TEST_SUITE_P(All, FuzzTarget, testing::ValuesIn(cairn::fuzz::kTargets),
                         [](const auto& test) { return std::string(test.param.reader); });

TEST_P(FuzzTarget, HasSeeds) { EXPECT_FALSE(files_in(here / "corpus" / GetParam().reader).empty()); }

TEST_P(FuzzTarget, SurvivesItsSeeds) { run_all(here / "corpus"); }

TEST_P(FuzzTarget, SurvivesWhatOnceCrashed) { run_all(here / "crashes"); }

TEST_P(FuzzTarget, SurvivesNothing) { EXPECT_NO_THROW(GetParam().run(nullptr, 0)); }

}  // namespace
