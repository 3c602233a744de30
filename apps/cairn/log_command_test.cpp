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

const std::string kLog =
    "PARAM robot_frontlaser_offset 0.3 nohost 0\n"
    "ODOM 1 2 0.5 0.1 0.2 0 11.5 nohost 0.5\n"
    "ODOM 2 2 0.5 0.1 0.2 0 12.0 nohost 0.5\n"
    "FLASER 3 1.5 2 90 9 9 9 1 2 0.5 12.5 nohost 0.1\n"
    "ODOM bad\n";

class LogCommand : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& text) {
    std::ofstream(folder_ / "a.log") << text;
    return (folder_ / "a.log").string();
  }
  /// What the command prints.
  static std::string output_of(const std::string& arguments) {
    return test::output_of(add_log, "log " + arguments);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("cairn_log_command_" + std::to_string(getpid()));
};

TEST_F(LogCommand, TableIsLinedUp) {
  const std::string text = output_of("info " + write(kLog));
  EXPECT_THAT(text, HasSubstr("carmen log: 4 messages, 1.0 s (11.500 to 12.500)\n"));
  EXPECT_THAT(text,
              HasSubstr("\nlaser   beams     angles deg        range m   valid  mount x m, y m, yaw deg\n"
                        "flaser      3  -90.0 to 90.0  0.01 to 80.00  66.7 %        0.300, 0.000, 0.0\n"));
  EXPECT_THAT(text, HasSubstr("\nwarnings\n       1  malformed line\n"));
}

TEST_F(LogCommand, Json) {
  const auto json = nlohmann::json::parse(output_of("info --json " + write(kLog)));
  EXPECT_EQ(json["streams"].size(), 3U);
  EXPECT_EQ(json["warnings"][0]["kind"], "malformed line");
}

TEST_F(LogCommand, UnknownContentAndMissingFileAreInputErrors) {
  EXPECT_THROW(output_of("info " + write("hello\n")), InputError);
  EXPECT_THROW(output_of("info /no/such/file"), InputError);
}

}  // namespace
}  // namespace cairn::app
