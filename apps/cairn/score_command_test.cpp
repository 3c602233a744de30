#include "apps/cairn/commands.hpp"
#include "cairn/core/errors.hpp"
#include "tests/support/command_output.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace cairn::app {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ScoreCommand : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  /// What the command prints.
  static std::string output_of(const std::string& arguments) {
    return test::output_of(add_score, "score " + arguments);
  }

  fs::path folder_ = fs::temp_directory_path() / ("cairn_score_test" + std::to_string(getpid()));
};

TEST_F(ScoreCommand, PrintsWhatItMeasured) {
  const std::string reference = write("ref", "0.5 0 0 0\n1.5 1 0 0\n2.5 2 0 0\n");
  const std::string estimate = write("est", "0.5, 0, 0.03, 0\n2.5, 2, 0.03, 0\n");
  const std::string text = output_of("--reference " + reference + " --estimate " + estimate);
  EXPECT_THAT(text, HasSubstr("mean 3.00 +- 0.00 cm"));
  EXPECT_THAT(text, HasSubstr("3 of 3 reference poses"));
  EXPECT_THAT(text, HasSubstr("lost      no"));
}

TEST_F(ScoreCommand, OffsetAndJson) {
  const std::string reference = write("ref", "0.5 0.08 0 0\n1.5 1.08 0 0\n");
  const std::string estimate = write("est", "0.5 0 0 0\n1.5 1 0 0\n");
  const auto json = nlohmann::json::parse(
      output_of("--reference " + reference + " --estimate " + estimate + " --offset 0.08,0,0 --json"));
  EXPECT_NEAR(json["position"]["max_m"].get<double>(), 0.0, 1e-12);
}

TEST_F(ScoreCommand, ALogStampsAPathThatNumbersItsPoses) {
  const std::string numbered = write("numbered", "0 0 0 0\n1 1 0 0\n");
  const std::string estimate = write("est", "1.5 0 0.02 0\n2.5 1 0.02 0\n");
  std::string log;
  for (const char* t : {"0.5", "1.5", "2.5"}) log += std::string("FLASER 2 1 1 0 0 0 0 0 0 ") + t + " h 0\n";
  const std::string files = "--reference " + numbered + " --estimate " + estimate;
  EXPECT_THROW(output_of(files), InputError);
  EXPECT_THAT(output_of(files + " --log " + write("a.log", log)), HasSubstr("mean 2.00 +- 0.00 cm"));
}

TEST_F(ScoreCommand, BadInputIsAnError) {
  const std::string reference = write("ref", "0.5 0.08 0 0\n1.5 1.08 0 zero\n");
  EXPECT_THROW(output_of("--reference " + reference + " --estimate " + reference), InputError);
  const std::string good = write("good", "0.5 0.08 0 0\n1.5 1.08 0 0\n");
  EXPECT_THROW(output_of("--reference " + good + " --estimate " + folder_.string()), InputError);
  EXPECT_THROW(output_of("--reference " + good + " --estimate " + good + " --align scaled"),
               ConfigurationError);
  EXPECT_THROW(output_of("--reference " + good), CLI::ParseError);
}

}  // namespace
}  // namespace cairn::app
