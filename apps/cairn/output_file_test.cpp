#include "apps/cairn/output_file.hpp"

#include "cairn/core/errors.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

class OutputFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_ = fs::temp_directory_path() / ("cairn_output_file_" + std::to_string(getpid()));
};

TEST_F(OutputFile, MakesTheFoldersThatAreMissingAndNoFile) {
  prepare_output_file(folder_ / "a" / "b" / "map.yaml");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  EXPECT_TRUE(fs::is_empty(folder_ / "a" / "b"));
}

TEST_F(OutputFile, LeavesAnExistingFileAlone) {
  std::ofstream(folder_ / "map.yaml") << "kept";
  prepare_output_file(folder_ / "map.yaml");
  EXPECT_EQ(fs::file_size(folder_ / "map.yaml"), 4u);
}

TEST_F(OutputFile, RefusesWhatIsNoPlaceForAFile) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(prepare_output_file(""), ConfigurationError);
  EXPECT_THROW(prepare_output_file(folder_), ConfigurationError);
  EXPECT_THROW(prepare_output_file(folder_ / "file" / "map.yaml"), ConfigurationError);
}

TEST_F(OutputFile, MakesAFolderOrRefuses) {
  prepare_output_folder(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(prepare_output_folder(""), ConfigurationError);
  EXPECT_THROW(prepare_output_folder(folder_ / "file"), ConfigurationError);
  EXPECT_THROW(prepare_output_folder(folder_ / "file" / "below"), ConfigurationError);
}

TEST_F(OutputFile, RefusesAFolderWithoutPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(prepare_output_file(folder_ / "map.yaml"), ConfigurationError);
  fs::permissions(folder_, fs::perms::owner_all);
}

}  // namespace
}  // namespace cairn::app
