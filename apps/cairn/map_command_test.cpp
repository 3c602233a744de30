#include "apps/cairn/commands.hpp"
#include "cairn/core/errors.hpp"
#include "tests/support/command_output.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace cairn::app {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MapCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    write("room.log", room_log());
    write("path.txt", "0.5 0 0 0\n10.5 0 0 0\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The robot stands in the middle of the south wall of a room of 4 x 2 m.
  static std::string room_log() {
    std::ostringstream log;
    for (int scan = 1; scan <= 10; ++scan) {
      log << "FLASER 180";
      for (int degree = -90; degree < 90; ++degree) {
        const double a = degree * 3.14159265358979 / 180;
        log << ' '
            << std::min(2.0 / std::max(1e-9, std::cos(a)), 2.0 / std::max(1e-9, std::abs(std::sin(a))));
      }
      log << " 0 0 0 0 0 0 " << scan << " host " << scan << "\n";
    }
    return log.str();
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  static std::string output_of(const std::string& arguments) {
    return test::output_of(add_map, "map " + arguments);
  }
  std::string build(const std::string& more) {
    return output_of("build --log " + path("room.log") + " --trajectory " + path("path.txt") + " --out " +
                     path("m.yaml") + " --max-gap-s 20 " + more);
  }

  const std::string name_ = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path folder_ = fs::temp_directory_path() / ("cairn_map_command_" + name_ + std::to_string(getpid()));
};

TEST_F(MapCommand, BuildsAMapThatInfoDescribes) {
  build("--trajectory-frame sensor");
  const auto json = nlohmann::json::parse(output_of("info " + path("m.yaml") + " --json"));
  EXPECT_NEAR(json["width_m"].get<double>(), 2.05, 0.06);
  EXPECT_NEAR(json["height_m"].get<double>(), 4.05, 0.11);
  EXPECT_NEAR(json["free_area_m2"].get<double>(), 8.0, 0.5);
  EXPECT_GT(json["occupied_share"].get<double>(), 0.01);
  EXPECT_EQ(json["checksum"].get<std::string>().size(), 16u);
  EXPECT_THAT(output_of("info " + path("m.yaml")), HasSubstr("cells of 0.05 m"));
}

TEST_F(MapCommand, PutsTheLaserWhereTheMountSays) {
  build("--mount 10,0,0");
  const auto json = nlohmann::json::parse(output_of("info " + path("m.yaml") + " --json"));
  EXPECT_NEAR(json["origin"]["x_m"].get<double>(), 10.0, 0.06);
}

TEST_F(MapCommand, MakesTheFolderOfTheMap) {
  const std::string map = path("maps/of/m.yaml");
  output_of("build --log " + path("room.log") + " --trajectory " + path("path.txt") +
            " --max-gap-s 20 --mount 0,0,0 --out " + map);
  EXPECT_THAT(output_of("info " + map), HasSubstr("cells of 0.05 m"));
}

TEST_F(MapCommand, RefusesAnOutputThatIsNoFileBeforeItReadsTheLog) {
  EXPECT_THROW(output_of("build --log " + path("none.log") + " --trajectory " + path("path.txt") + " --out " +
                         folder_.string()),
               ConfigurationError);
}

TEST_F(MapCommand, RefusesWhatItCannotUse) {
  EXPECT_THROW(build(""), ConfigurationError);  // no mount
  EXPECT_THROW(build("--mount 1,2"), ConfigurationError);
  EXPECT_THROW(build("--mount 0,0,0 --trajectory-frame lidar"), ConfigurationError);
  EXPECT_THROW(build("--mount 0,0,0 --resolution 0"), ConfigurationError);
  EXPECT_THROW(build("--mount 0,0,0 --stream rear"), ConfigurationError);
  write("path.txt", "100 0 0 0\n110 0 0 0\n");
  EXPECT_THROW(build("--mount 0,0,0"), InputError);
  EXPECT_THROW(output_of("info " + path("none.yaml")), InputError);
  EXPECT_THROW(output_of("info " + folder_.string()), InputError);
}

}  // namespace
}  // namespace cairn::app
