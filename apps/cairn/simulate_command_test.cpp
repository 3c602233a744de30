#include "apps/cairn/commands.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "tests/support/command_output.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn::app {
namespace {

class SimulateCommand : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// What `cairn simulate <arguments>` prints.
  static std::string simulate(const std::string& arguments) {
    return test::output_of(add_simulate, "simulate " + arguments);
  }

  std::string bytes(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("cairn_simulate_" + std::to_string(getpid()));
};

TEST_F(SimulateCommand, WritesALogItsTruthAndItsMap) {
  EXPECT_THAT(simulate("office --duration 10 --out " + path("a.log")),
              ::testing::HasSubstr("start     1,1.2,0\n"));
  const Log log = read_log(path("a.log"));
  EXPECT_EQ(log.format, "carmen");
  EXPECT_TRUE(log.diagnostics.empty());
  Diagnostics diagnostics;
  const Trajectory truth = read_trajectory(path("a.truth.tum"), {}, diagnostics);
  EXPECT_EQ(truth.size(), 501U);
  EXPECT_EQ(truth.front().pose, (Pose2{1.0, 1.2, 0.0}));
  EXPECT_EQ(read_map(path("a.map.yaml"))->state_at({1.0, 1.2}), CellState::kFree);
}

TEST_F(SimulateCommand, TheSameSeedGivesTheSameBytes) {
  const auto make = [&](const std::string& name, const std::string& seed) {
    simulate("office --duration 5 --seed " + seed + " --out " + path(name));
  };
  make("a.log", "3");
  make("b.log", "3");
  make("c.log", "4");
  ASSERT_FALSE(bytes("a.log").empty());
  EXPECT_EQ(bytes("a.log"), bytes("b.log"));
  EXPECT_EQ(bytes("a.truth.tum"), bytes("b.truth.tum"));
  EXPECT_EQ(bytes("a.map.png"), bytes("b.map.png"));
  EXPECT_NE(bytes("a.log"), bytes("c.log"));
  EXPECT_NE(bytes("a.map.png"), bytes("c.map.png"));
}

TEST_F(SimulateCommand, RefusesWhatItCannotDo) {
  EXPECT_THROW(simulate("world.yaml --out " + path("a.log")), ConfigurationError);
  EXPECT_THROW(simulate("office --duration 1e9 --out " + path("a.log")), ConfigurationError);
  EXPECT_THROW(simulate("office --duration 1 --out " + path("no/folder/a.log")), InputError);
}

}  // namespace
}  // namespace cairn::app
