#include "apps/cairn/map_convert.hpp"

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

using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MapConvert : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "room.txt") << "0,0,6,0\n6,0,6,4\n6,4,0,4\n0,4,0,0\n2,1,2,3\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string output_of(const std::string& arguments) {
    return test::output_of(add_map, "map " + arguments);
  }
  void convert(const std::string& from, const std::string& to, const std::string& more = "") const {
    output_of("convert " + path(from) + " " + path(to) + " " + more);
  }
  json info(const std::string& name) const { return json::parse(output_of("info --json " + path(name))); }

  const std::string name_ = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path folder_ = fs::temp_directory_path() / ("cairn_map_convert_" + name_ + std::to_string(getpid()));
};

TEST_F(MapConvert, TextToGeoJsonKeepsEveryWall) {
  convert("room.txt", "room.geojson");
  EXPECT_EQ(info("room.geojson"), info("room.txt"));
  EXPECT_EQ(info("room.txt")["walls"], 5);
  EXPECT_EQ(info("room.txt")["materials"]["opaque"], 5);
  EXPECT_DOUBLE_EQ(info("room.txt")["length_m"], 22.0);
  EXPECT_THAT(output_of("info " + path("room.txt")), HasSubstr("walls     5 (5 opaque), 22.0 m"));
}

TEST_F(MapConvert, WallsToGridAndBack) {
  convert("room.txt", "room.yaml", "--resolution 0.1");
  EXPECT_NEAR(info("room.yaml")["free_area_m2"], 24.0, 1.5);
  convert("room.yaml", "again.geojson");
  EXPECT_EQ(info("again.geojson")["walls"], 5);
  EXPECT_NEAR(info("again.geojson")["length_m"], 22.0, 0.6);
}

TEST_F(MapConvert, InsideSaysWhatIsFree) {
  convert("room.txt", "out.yaml", "--resolution 0.1 --inside=-0.3,-0.3");
  EXPECT_LT(info("out.yaml")["free_area_m2"], 14.0);
  EXPECT_THROW(convert("room.txt", "out.yaml", "--inside=2,2"), ConfigurationError);
  EXPECT_THROW(convert("room.txt", "out.yaml", "--inside=2;2"), ConfigurationError);
  EXPECT_THROW(convert("room.txt", "out.yaml", "--inside=2,"), ConfigurationError);
}

TEST_F(MapConvert, LayersOfADrawingHaveMaterials) {
  std::ofstream(folder_ / "d.dxf") << "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nA\n10\n0\n20\n0\n11\n100\n21\n0\n"
                                      "0\nENDSEC\n0\nEOF\n";
  convert("d.dxf", "d.geojson", "--layer A=mesh --unit 0.01");
  EXPECT_EQ(info("d.geojson")["materials"]["mesh"], 1);
  EXPECT_DOUBLE_EQ(info("d.geojson")["length_m"], 1.0);
  EXPECT_DOUBLE_EQ(info("d.dxf")["length_m"], 100.0);
  EXPECT_THROW(convert("d.dxf", "d.geojson", "--layer A=wood"), ConfigurationError);
  EXPECT_THROW(convert("d.dxf", "d.geojson", "--layer A"), ConfigurationError);
}

TEST_F(MapConvert, RefusesWhatItCannotWrite) {
  EXPECT_THROW(convert("room.txt", "room.map"), ConfigurationError);
  EXPECT_THROW(convert("missing.txt", "room.yaml"), InputError);
}

}  // namespace
}  // namespace cairn::app
