#include "apps/cairn/run_directory.hpp"

#include "apps/cairn/run_tables.hpp"
#include "cairn/core/errors.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunDirectory : public testing::Test {
 protected:
  RunDirectory() {
    std::string name = (fs::temp_directory_path() / "cairn_run_XXXXXX").string();
    root_ = mkdtemp(name.data());
    directory_ = root_ / "out";
  }
  ~RunDirectory() override { fs::remove_all(root_); }

  std::string content(const char* name) const {
    std::ifstream file(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string error_of_reading() const {
    try {
      read_run(directory_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path root_;
  fs::path directory_;
};

Time at(double seconds) { return time_from_seconds(seconds); }

RunData small_run() {
  RunData run;
  run.trajectory = {{at(1.25), {1.0, -2.5, 0.1}}, {at(976052857.33753), {1.0 / 3.0, 1e-7, -3.0}}};
  Estimate e;
  e.stamp = at(1.25);
  e.T_map_base = {0.1, 2.0 / 7.0, -1.5};
  e.covariance << 0.01, 1e-17, -0.003, 1e-17, 0.04, 0.2 / 3.0, -0.003, 0.2 / 3.0, 0.5;
  e.ess = 123.456;
  e.particles = 500;
  e.hypotheses = 2;
  e.weight = 0.9;
  e.quality = 0.75;
  e.judgement = {TrackingState::kCrowded, 0.91, 0.6, 0.37, 0.01, -0.2 / 3.0, 0.03, 0.11, 0.45};
  run.estimates = {e};
  run.metrics = {{"cairn_version", "0.1.0"}, {"recipe", "mcl"}};
  run.configuration = "recipe: mcl\n";
  run.particles = {{at(1.0), {{1, 2, 3}, {4, 5, -3}}}, {at(2.0), {{0.1, 0.2, 0.3}}}};
  run.map = std::make_shared<OccupancyGrid>(GridGeometry{3, 2, 0.05, {-1.5, 2.25, 0.5}},
                                            std::vector<OccupancyGrid::Cell>{0, 100, -1, 100, 0, 0});
  run.reference = Trajectory{{at(0.0), {0, 0, 0}}};
  return run;
}

TEST_F(RunDirectory, ReadsBackWhatWasWritten) {
  const RunData run = small_run();
  write_run(directory_, run);
  const RunData read = read_run(directory_);
  ASSERT_EQ(read.trajectory.size(), 2u);
  EXPECT_EQ(read.trajectory[1].stamp, run.trajectory[1].stamp);
  EXPECT_NEAR(read.trajectory[1].pose.x, run.trajectory[1].pose.x, 1e-9);
  EXPECT_NEAR(read.trajectory[1].pose.theta, -3.0, 1e-11);
  ASSERT_EQ(read.estimates.size(), 1u);
  EXPECT_EQ(read.estimates[0].T_map_base, run.estimates[0].T_map_base);
  EXPECT_EQ(read.estimates[0].covariance, run.estimates[0].covariance);
  EXPECT_EQ(read.estimates[0].particles, 500);
  EXPECT_EQ(read.estimates[0].quality, 0.75);
  EXPECT_EQ(read.metrics, run.metrics);
  EXPECT_EQ(read.configuration, run.configuration);
  ASSERT_EQ(read.particles.size(), 2u);
  EXPECT_EQ(read.particles[0].particles, run.particles[0].particles);
  EXPECT_EQ(read.reference, run.reference);
  ASSERT_TRUE(read.map);
  EXPECT_EQ(read.map->geometry(), run.map->geometry());
  EXPECT_EQ(read.map->cells(), run.map->cells());
}

TEST_F(RunDirectory, WritesTheSameBytesAgain) {
  write_run(directory_, small_run());
  const std::string trajectory = content("trajectory.tum");
  const std::string estimate = content("estimate.csv");
  write_run(directory_, small_run());
  EXPECT_EQ(content("trajectory.tum"), trajectory);
  EXPECT_EQ(content("estimate.csv"), estimate);
  EXPECT_THAT(trajectory, testing::StartsWith("1.250000000 1.000000000 -2.500000000 0 0 0 0.049979169271 "));
  EXPECT_THAT(estimate, HasSubstr("\n1.250000000,0.1,0.2857142857142857,-1.5,0.01,1e-17,-0.003,"));
}

TEST_F(RunDirectory, LeavesNothingOfAnEarlierRunBehind) {
  write_run(directory_, small_run());
  write_file(directory_ / "report.html", "old");
  RunData bare = small_run();
  bare.reference.reset();
  bare.particles.clear();
  bare.map.reset();
  write_run(directory_, bare);
  EXPECT_FALSE(fs::exists(directory_ / "report.html"));
  EXPECT_FALSE(fs::exists(directory_ / ".writing"));
  EXPECT_FALSE(fs::exists(directory_ / "map.png"));
  EXPECT_FALSE(read_run(directory_).reference.has_value());
  EXPECT_TRUE(read_run(directory_).particles.empty());
}

TEST_F(RunDirectory, RefusesAFolderWithForeignFiles) {
  fs::create_directories(directory_);
  EXPECT_NO_THROW(check_run_directory(directory_));
  write_file(directory_ / "metrics.json", "{\"loss\": 0.1}");
  EXPECT_THROW(write_run(directory_, small_run()), ConfigurationError);
  EXPECT_EQ(content("metrics.json"), "{\"loss\": 0.1}");
  EXPECT_THROW(check_run_directory(directory_ / "metrics.json"), ConfigurationError);
}

TEST_F(RunDirectory, RefusesWhereNoFolderCanBeMade) {
  EXPECT_THROW(check_run_directory(""), ConfigurationError);
  fs::create_directories(directory_);
  write_file(directory_ / "letter.txt", "mine");
  EXPECT_THROW(check_run_directory(directory_ / "letter.txt" / "below" / "deep"), ConfigurationError);
  EXPECT_NO_THROW(check_run_directory(directory_ / "new" / "and" / "deep"));
  EXPECT_FALSE(fs::exists(directory_ / "new")) << "a check makes nothing";
}

TEST_F(RunDirectory, TakesOverARunWhoseWritingWasCutShort) {
  write_run(directory_, small_run());
  fs::remove(directory_ / "metrics.json");
  fs::create_directories(directory_ / ".writing");
  EXPECT_THAT(error_of_reading(), HasSubstr("metrics.json: is missing"));
  EXPECT_NO_THROW(write_run(directory_, small_run()));
  EXPECT_EQ(error_of_reading(), "");
}

TEST_F(RunDirectory, NamesTheMissingFile) {
  EXPECT_THAT(error_of_reading(), HasSubstr("is not a folder"));
  for (const char* name : {"trajectory.tum", "estimate.csv", "config.yaml", "metrics.json"}) {
    write_run(directory_, small_run());
    fs::remove(directory_ / name);
    EXPECT_THAT(error_of_reading(), HasSubstr(std::string(name) + ": is missing; write the run again"));
    fs::remove_all(directory_);
  }
}

TEST_F(RunDirectory, TakesARunWithoutASinglePose) {
  RunData run;
  run.metrics = {{"cairn_version", "0.1.0"}};
  write_run(directory_, run);
  const RunData read = read_run(directory_);
  EXPECT_TRUE(read.trajectory.empty());
  EXPECT_TRUE(read.estimates.empty());
  EXPECT_FALSE(read.map);
}

TEST_F(RunDirectory, KeepsNamesThatAreNotUtf8Readable) {
  RunData run = small_run();
  run.metrics["recipe"] = "caf\xE9";
  write_run(directory_, run);
  EXPECT_EQ(read_run(directory_).metrics["recipe"], "caf\xEF\xBF\xBD");
}

TEST(RunTables, AreReadWholeOrRefusedWhereverTheyAreCut) {
  const RunData run = small_run();
  const std::string tum = to_tum(run.trajectory);
  const std::string csv = to_csv(run.estimates);
  for (std::size_t n = 0; n < tum.size(); ++n) {
    const bool whole_rows = n == 0 || tum[n - 1] == '\n';
    if (whole_rows) continue;
    EXPECT_THROW(parse_tum(tum.substr(0, n), "t"), InputError) << n;
  }
  for (std::size_t n = 0; n < csv.size(); ++n) {
    const bool whole_rows = n == kEstimateHeader.size() + 1;
    if (whole_rows) continue;
    EXPECT_THROW(parse_estimates(csv.substr(0, n), "e"), InputError) << n;
  }
}

TEST(RunTables, KeepWhatAnEstimateThinksOfItself) {
  const RunData run = small_run();
  const Judgement before = run.estimates.front().judgement;
  const Judgement after = parse_estimates(to_csv(run.estimates), "e").front().judgement;
  EXPECT_EQ(after.state, before.state);
  EXPECT_EQ(after.probability, before.probability);
  EXPECT_EQ(after.explained, before.explained);
  EXPECT_EQ(after.blocked, before.blocked);
  EXPECT_EQ(after.beyond, before.beyond);
  EXPECT_EQ(after.fit, before.fit);
  EXPECT_EQ(after.innovation, before.innovation);
  EXPECT_EQ(after.entropy, before.entropy);
  EXPECT_EQ(after.drift, before.drift);
  const std::string row = to_csv(run.estimates);
  EXPECT_NE(row.find(",crowded,0.91,0.6,0.37,0.01,-0.06666666666666667,0.03,0.11,0.45\n"), std::string::npos)
      << row;
}

TEST(RunTables, KeepLargeRoundCounts) {
  RunData run = small_run();
  run.estimates.front().particles = 100000;
  const auto back = parse_estimates(to_csv(run.estimates), "e");
  EXPECT_EQ(back.front().particles, 100000);
}

TEST(RunTables, SayWhereTheDamageIs) {
  const std::string header = std::string(kParticleHeader) + "\n";
  const auto error = [&](const std::string& rows) -> std::string {
    try {
      parse_particles(header + rows, "particles.csv");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error("1.0,1,2,3\n"), "");
  EXPECT_THAT(error("1.0,1,2,3\n2.0,1,two,3\n"),
              HasSubstr("particles.csv:3: 'two' is not a finite number; "));
  EXPECT_THAT(error("1.0,1,nan,3\n"), HasSubstr(":2: 'nan'"));
  EXPECT_THAT(error("1.0,1,inf,3\n"), HasSubstr(":2: 'inf'"));
  EXPECT_THAT(error("x,1,2,3\n"), HasSubstr(":2: 'x' is not a time"));
  EXPECT_THAT(error("1.0,1,2\n"), HasSubstr("too few"));
  EXPECT_THAT(error("1.0,1,2,3,4\n"), HasSubstr("too many"));
  EXPECT_THAT(error("2.0,1,2,3\n1.0,1,2,3\n"), HasSubstr(":3: the stamp is not later"));
  EXPECT_THROW(parse_particles("t,x\n", "p"), InputError);
}

TEST_F(RunDirectory, ARecordingIsWrittenBesideTheEarlierRunAndPublishedWithTheRest) {
  write_run(directory_, small_run());
  const fs::path recording = prepare_recording(directory_);
  EXPECT_EQ(error_of_reading(), "");  // the earlier run is whole
  write_file(recording, "recorded");
  EXPECT_EQ(find_recording(directory_), recording);  // as after a kill
  RunData run = small_run();
  run.recorded = true;
  write_run(directory_, run);
  EXPECT_EQ(content("run.mcap"), "recorded");
  EXPECT_EQ(find_recording(directory_), directory_ / "run.mcap");
  EXPECT_FALSE(fs::exists(recording));
}

TEST_F(RunDirectory, ARunThatIsNotRecordedLeavesNoRecordingOfAnEarlierOne) {
  write_file(prepare_recording(directory_), "recorded");
  write_run(directory_, small_run());
  EXPECT_FALSE(fs::exists(directory_ / "run.mcap"));
  EXPECT_THROW(find_recording(directory_), InputError);
}

}  // namespace
}  // namespace cairn::app
