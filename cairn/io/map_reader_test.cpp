#include "cairn/io/map_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/ndt_file.hpp"
#include "test_data.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ReadMap : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string error_of(const fs::path& path) {
    try {
      read_map(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const std::string name_ = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path folder_ = fs::temp_directory_path() / ("cairn_read_map_" + name_ + std::to_string(getpid()));
};

/// One cell of every value, with an origin and a yaw that no short decimal names.
OccupancyGrid every_value() {
  std::vector<OccupancyGrid::Cell> cells;
  for (int cell = -1; cell <= 100; ++cell) cells.push_back(static_cast<OccupancyGrid::Cell>(cell));
  return OccupancyGrid({17, 6, 0.05, {1.0 / 3.0, -2.0 / 7.0, 0.1}}, cells);
}

TEST_F(ReadMap, ReadsBackEveryStateThatWasWritten) {
  const OccupancyGrid grid = every_value();
  for (const MapImageFormat format : {MapImageFormat::kPng, MapImageFormat::kPgm}) {
    write_map(folder_ / "m.yaml", grid, format);
    const auto back = read_map(folder_ / "m.yaml");
    EXPECT_EQ(back->geometry(), grid.geometry());
    for (std::size_t i = 0; i < grid.cells().size(); ++i) EXPECT_EQ(back->state(i), grid.state(i)) << i;
  }
}

TEST_F(ReadMap, WrittenGreysKeepTheProbabilityWithinAClass) {
  const OccupancyGrid grid = every_value();
  const GrayImage image = to_image(grid);
  for (std::size_t i = 0; i < grid.cells().size(); ++i) {
    const int cell = grid.cells()[i];
    const std::size_t pixel = (5 - i / 17) * 17 + i % 17;
    if (grid.state(i) == CellState::kUnknown || cell == 0 || (cell > 19 && cell < 25)) continue;
    EXPECT_NEAR(100 * (1 - image.gray[pixel] / 255.0), cell, 0.2) << cell;
  }
}

TEST_F(ReadMap, FindsThePictureBesideTheYaml) {
  write("with space.pgm", std::string("P5\n1 1\n255\n\0", 12));
  const auto map = read_map(write("m.yaml", "image: with space.pgm\nresolution: 1\norigin: [0, 0, 0]\n"));
  EXPECT_EQ(map->count(CellState::kOccupied), 1u);
}

TEST_F(ReadMap, NamesTheFileAtFault) {
  const std::string yaml = "resolution: 1\norigin: [0, 0, 0]\nimage: ";
  EXPECT_THAT(error_of(write("a.yaml", yaml + "none.png\n")), HasSubstr("none.png: no such file"));
  write("b.png", "BM bitmap");
  EXPECT_THAT(error_of(write("b.yaml", yaml + "b.png\n")), HasSubstr("b.png: is neither PNG nor PGM"));
  EXPECT_THAT(error_of(write("c.pgm", "P5\n1 1\n255\na")), HasSubstr("name the map's .yaml file"));
  EXPECT_THAT(error_of(write("d.yaml", "")), HasSubstr("is empty"));
  EXPECT_THAT(error_of(folder_), HasSubstr("is a directory"));
  EXPECT_THAT(error_of(write("e.yaml", yaml + ".\n")), HasSubstr("is a directory"));
  EXPECT_THAT(error_of(write("f.yaml", std::string(3 << 20, 'x'))), HasSubstr("no known map format"));
  EXPECT_THAT(error_of(write("g.yaml", std::string("\0\1\2\3", 4))), HasSubstr("g.yaml"));
}

TEST_F(ReadMap, WritingWhereOneCannotIsAnError) {
  EXPECT_THROW(write_map("/no/such/folder/m.yaml", every_value()), InputError);
  EXPECT_THROW(write_map(folder_ / "m.png", every_value()), InputError);
  fs::create_directories(folder_ / "d.yaml");
  EXPECT_THROW(write_map(folder_ / "d.yaml", every_value()), InputError);
}

TEST_F(ReadMap, ReadsTheRealMaps) {
  struct RealMap {
    const char* file;
    double resolution_m;
  };
  for (const auto& [file, resolution_m] :
       {RealMap{"jarvis_nav350/maps/derived_from_circular_run.yaml", 0.05},
        RealMap{"radish_derived/maps/intel.yaml", 0.1}, RealMap{"mrpt_uwb_laser/map.yaml", 0.04},
        RealMap{"olin_mac/mac_1st_floor_final.yaml", 0.03}, RealMap{"wean/wean.dat.gz", 0.1}}) {
    CAIRN_SKIP_WITHOUT(file);
    const auto map = read_map(test::data_file(file));
    EXPECT_NEAR(map->geometry().resolution_m, resolution_m, 1e-12) << file;
    EXPECT_GT(map->count(CellState::kOccupied), 1000u) << file;
    EXPECT_GT(map->count(CellState::kFree), 10000u) << file;
  }
}

TEST_F(ReadMap, TakesTheRepresentationsThatTheYamlFileNames) {
  write_map(folder_ / "m.yaml", every_value());
  const std::vector<Point2> points{{0.1, 0.1}, {0.2, 0.1}, {0.3, 0.15}};
  std::ofstream ndt(folder_ / "m.ndt");
  write_ndt(ndt, ndt_from_points(points, {}));
  ndt.close();
  write("walls.txt", "0,0,1,0\n1,0,1,1\n");
  std::ofstream(folder_ / "m.yaml", std::ios::app) << "ndt: m.ndt\nwalls: walls.txt\n";
  Diagnostics diagnostics;
  const auto maps = read_map_set(folder_ / "m.yaml", diagnostics);
  EXPECT_TRUE(diagnostics.counts().empty());
  ASSERT_NE(maps->find<NdtMap>(), nullptr);
  EXPECT_EQ(maps->find<NdtMap>()->cells().size(), ndt_from_points(points, {}).cells().size());
  ASSERT_NE(maps->find<VectorMap>(), nullptr);
  EXPECT_EQ(maps->find<VectorMap>()->walls().size(), 2u);
  EXPECT_EQ(maps->grid()->geometry(), every_value().geometry()) << "the grid is the picture, not the walls";
}

TEST_F(ReadMap, RefusesARepresentationOfAnotherKind) {
  write_map(folder_ / "m.yaml", every_value());
  write("walls.txt", "0,0,1,0\n");
  std::ofstream(folder_ / "m.yaml", std::ios::app) << "ndt: walls.txt\n";
  Diagnostics diagnostics;
  try {
    read_map_set(folder_ / "m.yaml", diagnostics);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("names walls.txt as its NDT map, which it is not"));
  }
}

}  // namespace
}  // namespace cairn
