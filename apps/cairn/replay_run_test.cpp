#include "apps/cairn/replay_run.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/maps/checksum.hpp"
#include "small_room.hpp"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

// Two seconds of a circle in the small room, recorded while they are localized.
class ReplayRun : public testing::Test {
 protected:
  ReplayRun() {
    std::string name = (fs::temp_directory_path() / "cairn_replay_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    write_map(folder_ / "map.yaml", test::small_room());
    log_.streams = test::odometry_and_laser();
    for (int i = 0; i <= 40; ++i) {
      log_.events.push_back(test::odometry_event(0.05 * i, test::on_circle({}, 0.05 * i)));
      if (i % 4 != 0) continue;
      const Pose2 pose = test::on_circle({2.0, 1.5, 0.0}, 0.05 * i);
      log_.events.push_back(test::scan_event(test::scan_from(test::small_room(), pose, test::at(0.05 * i))));
    }
    options_.filter.min_particles = 200;
  }
  ~ReplayRun() override { fs::remove_all(folder_); }

  void record(bool finish = true) {
    Diagnostics diagnostics;
    const auto map = read_map(folder_ / "map.yaml", diagnostics);
    RunHeader header;
    header.configuration = write_configuration([&](OptionVisitor& v) { options_.visit(v); });
    header.seed = 5;
    header.T_map_base = Pose2{2.0, 1.5, 0.01};
    header.map_path = folder_ / "map.yaml";
    header.map_checksum = checksum(*map);
    const StreamMaps stream_maps = read_stream_maps(options_, diagnostics);
    header.stream_map_checksums = checksums(stream_maps);
    header.live = live_;
    Recorder recorder(folder_ / "run.mcap", header, log_.streams);
    LocalizeRequest request{.log = &log_,
                            .map = map,
                            .stream_maps = stream_maps,
                            .options = options_,
                            .start = {header.T_map_base},
                            .seed = 5,
                            .live = live_};
    request.on_event = [&](const Event& event) { recorder.record(event); };
    request.on_estimate = [&](const Estimate& estimate) { recorder.record(estimate); };
    estimates_ = localize(request).estimates;
    finish ? recorder.finish() : recorder.flush();
  }

  fs::path folder_;
  Log log_;
  LocalizerOptions options_;
  bool live_ = false;
  std::vector<Estimate> estimates_;
};

TEST_F(ReplayRun, GivesEveryEstimateToTheLastBitForAnyNumberOfThreads) {
  record();
  const RecordedRun run = read_recorded_run(folder_, "");
  EXPECT_EQ(run.recording.estimates.size(), estimates_.size());
  EXPECT_GE(estimates_.size(), 10U);
  for (const int threads : {1, 2, 7}) {
    EXPECT_FALSE(first_parting(run.recording, run_again(run, run.options, threads).estimates).has_value());
  }
}

TEST_F(ReplayRun, ALiveRunIsReplayedAsOne) {
  live_ = true;
  record();
  const RecordedRun run = read_recorded_run(folder_, "");
  EXPECT_EQ(run.recording.estimates.size(), 41U) << "one per message of the odometry";
  EXPECT_FALSE(first_parting(run.recording, run_again(run, run.options, 2).estimates).has_value());
}

TEST_F(ReplayRun, OtherOptionsPartFromTheRecording) {
  record();
  const RecordedRun run = read_recorded_run(folder_ / "run.mcap", "");
  LocalizerOptions other = run.options;
  other.motion.alpha1 *= 1.001;
  const auto parting = first_parting(run.recording, run_again(run, other, 1).estimates);
  ASSERT_TRUE(parting.has_value());
  EXPECT_NE(parting->difference.first, parting->difference.second);
}

TEST_F(ReplayRun, ThePartingIsTheFirstAndNamesItsField) {
  record();
  RecordedRun run = read_recorded_run(folder_, "");
  run.recording.estimates[3].covariance(0, 0) = std::nextafter(estimates_[3].covariance(0, 0), 1.0);
  run.recording.estimates[5].ess = 0.0;
  const Parting parting = first_parting(run.recording, estimates_).value();
  EXPECT_EQ(parting.number, 3U);
  EXPECT_EQ(parting.stamp, estimates_[3].stamp);
  EXPECT_EQ(parting.difference.field, "covariance_xx");
}

TEST_F(ReplayRun, MissingEstimatesPartUnlessTheRunWasKilled) {
  record();
  RecordedRun run = read_recorded_run(folder_, "");
  run.recording.estimates.pop_back();
  EXPECT_EQ(first_parting(run.recording, estimates_).value().difference.second, "there is one");
  run.recording.finished = false;
  EXPECT_FALSE(first_parting(run.recording, estimates_).has_value());
  std::vector<Estimate> fewer = estimates_;
  fewer.resize(2);
  EXPECT_EQ(first_parting(run.recording, fewer).value().number, 2U);
}

TEST_F(ReplayRun, ARunThatWasKilledIsReplayedAsFarAsItWasRecorded) {
  record(false);
  const RecordedRun run = read_recorded_run(folder_, "");
  EXPECT_FALSE(run.recording.finished);
  EXPECT_FALSE(first_parting(run.recording, run_again(run, run.options, 2).estimates).has_value());
}

TEST_F(ReplayRun, AChangedMapIsRefused) {
  record();
  const OccupancyGrid room = test::small_room();
  std::vector<OccupancyGrid::Cell> cells(room.geometry().size(), 0);
  write_map(folder_ / "map.yaml", OccupancyGrid(room.geometry(), std::move(cells)));
  try {
    read_recorded_run(folder_, "");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("is not the map of the recorded run"),
                                             testing::HasSubstr("--map")));
  }
  write_map(folder_ / "kept.yaml", room);
  EXPECT_NO_THROW(read_recorded_run(folder_, folder_ / "kept.yaml"));
}

TEST_F(ReplayRun, AChangedMapOfASingleStreamIsRefusedByItsName) {
  const OccupancyGrid room = test::small_room();
  const fs::path own = folder_ / "own.yaml";
  write_map(own, room);
  options_.streams[log_.streams[1].name].map = own;
  record();
  RecordedRun run = read_recorded_run(folder_, "");
  EXPECT_FALSE(first_parting(run.recording, run_again(run, run.options, 1).estimates).has_value());

  std::vector<OccupancyGrid::Cell> cells(room.geometry().size());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = room.state(i) == CellState::kOccupied ? 100 : 0;
  const auto middle = static_cast<std::size_t>(room.geometry().width) / 2;
  cells[cells.size() / 2 + middle] = 100;
  write_map(own, OccupancyGrid(room.geometry(), std::move(cells)));
  run = read_recorded_run(folder_, "");
  try {
    run_again(run, run.options, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("own.yaml: is not the map of the recorded run"),
                               testing::HasSubstr("streams.NAME.map")));
  }
  LocalizerOptions other = run.options;
  other.streams[log_.streams[1].name].map = folder_ / "map.yaml";
  EXPECT_NO_THROW(run_again(run, other, 1)) << "what if it had another map";
}

}  // namespace
}  // namespace cairn::app
