#include "cairn/io/recorder.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/io/estimate_message.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/recording.hpp"
#include "log_inspection.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cairn {
namespace {

namespace fs = std::filesystem;

const std::vector<StreamInfo> kStreams{{"odom", StreamKind::kOdometry, "", {}},
                                       {"scan", StreamKind::kLaserScan, "laser", Pose2{0.2, 0.0, 0.1}}};

RunHeader header() {
  return {"1.2.3",
          "filter:\n  particles: 7\n",
          18446744073709551615U,
          Pose2{0.1, -2.0 / 3.0, 3.1},
          "/maps/a.yaml",
          0xfedcba9876543210U,
          "/logs/a.log",
          "odom",
          {{"/maps/high.yaml", 17U}, {"/maps/low: 1.yaml", 0xffffffffffffffffU}},
          true};
}

// Event k of a made-up run: three of odometry, then a scan.
Event event(std::uint32_t k) {
  const Time stamp(Duration(std::int64_t{k} * 20'000'001));
  const double x = 0.1 * k;
  if (k % 4 != 3) return {stamp, stamp + Duration(k), 0, Odometry{stamp, {x, -x / 3.0, 1.0 / (x + 1.0)}}};
  LaserScan scan{stamp, -1.0 / 3.0, 0.01, 0.05, 30.0, std::vector<float>(180, static_cast<float>(x))};
  return {stamp, stamp + Duration(k), 1, std::make_shared<const LaserScan>(std::move(scan))};
}

Estimate estimate(std::uint32_t k) {
  Estimate e;
  e.stamp = Time(Duration(k));
  e.T_map_base = {1.0 / (k + 3.0), 1e-300 * k, -0.0};
  e.covariance << 0.1, 0.2, 0.3, 0.2, 1.0 / 3.0, 0.6, 0.3, 0.6, 1e9;
  e.ess = 12.5 + k;
  e.particles = static_cast<int>(k);
  e.hypotheses = 2;
  e.weight = 0.7;
  e.quality = 0.9;
  e.belief_stamp = Time(Duration(k / 2));
  e.T_map_odom = {0.1, -0.2 / (k + 1.0), 3.0};
  e.judgement = {TrackingState::kCrowded, 0.91, 0.6, 0.37, 0.01, -0.2 / (k + 1.0), 0.03, 0.11, 0.45};
  return e;
}

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    std::string name = (fs::temp_directory_path() / "cairn_recorder_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    file_ = folder_ / "run.mcap";
  }
  ~RecorderTest() override { fs::remove_all(folder_); }

  static void expect_prefix(const Recording& recording) {
    for (std::uint32_t k = 0; k < recording.log.events.size(); ++k) {
      ASSERT_EQ(exact::encode(recording.log.events[k]), exact::encode(event(k))) << k;
      ASSERT_EQ(recording.log.events[k].stream, event(k).stream);
    }
    for (std::uint32_t k = 0; k < recording.estimates.size(); ++k) {
      ASSERT_FALSE(exact::first_difference(recording.estimates[k], estimate(k)).has_value()) << k;
    }
  }

  fs::path folder_;
  fs::path file_;
};

TEST_F(RecorderTest, ARunComesBackToTheLastBit) {
  Recorder recorder(file_, header(), kStreams);
  for (std::uint32_t k = 0; k < 100; ++k) {
    recorder.record(event(k));
    recorder.record(estimate(k));
  }
  recorder.finish();
  const Recording recording = read_recording(file_);
  const RunHeader wanted = header();
  EXPECT_TRUE(recording.finished);
  EXPECT_TRUE(recording.log.diagnostics.empty());
  EXPECT_EQ(recording.header.cairn_version, wanted.cairn_version);
  EXPECT_EQ(recording.header.configuration, wanted.configuration);
  EXPECT_EQ(recording.header.seed, wanted.seed);
  EXPECT_EQ(recording.header.T_map_base, wanted.T_map_base);
  EXPECT_EQ(recording.header.map_path, wanted.map_path);
  EXPECT_EQ(recording.header.map_checksum, wanted.map_checksum);
  EXPECT_EQ(recording.header.log_path, wanted.log_path);
  EXPECT_EQ(recording.header.odometry_stream, wanted.odometry_stream);
  EXPECT_EQ(recording.header.stream_map_checksums, wanted.stream_map_checksums);
  EXPECT_EQ(recording.header.live, wanted.live);
  EXPECT_EQ(recording.log.events.size(), 100U);
  EXPECT_EQ(recording.estimates.size(), 100U);
  expect_prefix(recording);
}

TEST_F(RecorderTest, AStartFromAnywhereComesBack) {
  RunHeader anywhere = header();
  anywhere.T_map_base.reset();
  anywhere.live = false;
  anywhere.stream_map_checksums.clear();
  Recorder(file_, anywhere, kStreams).finish();
  const RunHeader read = read_recording(file_).header;
  EXPECT_FALSE(read.T_map_base.has_value());
  EXPECT_FALSE(read.live);
  EXPECT_TRUE(read.stream_map_checksums.empty());
}

TEST_F(RecorderTest, WhatASensorSaidIsRecordedEvenIfItIsNaN) {
  Event bad = event(0);
  std::get<Odometry>(bad.payload).T_odom_base.x = std::nan("");
  Recorder recorder(file_, header(), kStreams);
  recorder.record(bad);
  recorder.record(estimate(0));
  recorder.finish();
  EXPECT_EQ(exact::encode(read_recording(file_).log.events.at(0)), exact::encode(bad));
  EXPECT_EQ(test::count(read_log(file_), "malformed message"), 1);
}

TEST_F(RecorderTest, ARecordingIsALog) {
  Recorder recorder(file_, header(), kStreams);
  for (std::uint32_t k = 0; k < 8; ++k) recorder.record(event(k));
  recorder.finish();
  const Log log = read_log(file_);
  EXPECT_EQ(log.format, "cairn_mcap");
  EXPECT_EQ(log.events.size(), 8U);
  EXPECT_EQ(log.streams.at(1).T_base_sensor, kStreams[1].T_base_sensor);
}

// --- kill -9 ----------------------------------------------------------------------------------------------

// Records for ever, a few events per batch; after each flush it writes to the pipe how many are acknowledged.
[[noreturn]] void record_until_killed(const fs::path& file, int pipe, std::uint32_t batch) {
  Recorder recorder(file, header(), kStreams);
  for (std::uint32_t k = 0;; ++k) {
    recorder.record(event(k));
    recorder.record(estimate(k));
    if ((k + 1) % batch != 0) continue;
    recorder.flush();
    const std::uint32_t acknowledged = k + 1;
    if (write(pipe, &acknowledged, sizeof acknowledged) != sizeof acknowledged) _exit(1);
  }
}

// Kills the recorder some time after its n-th acknowledgement; returns the last one that came out.
std::uint32_t acknowledged_before_kill(const fs::path& file, std::uint32_t batch, int n) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) record_until_killed(file, ends[1], batch);
  close(ends[1]);
  std::uint32_t acknowledged = 0;
  for (int i = 0; i < n; ++i) {
    if (::read(ends[0], &acknowledged, sizeof acknowledged) != sizeof acknowledged) std::abort();
  }
  kill(child, SIGKILL);
  while (::read(ends[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged) {
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  return acknowledged;
}

TEST_F(RecorderTest, AKillLosesNothingThatWasAcknowledged) {
  const RandomStream random(7, RandomPurpose::kInitialize, 0);
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    const std::uint32_t batch = 1 + trial % 9;
    const int n = 1 + static_cast<int>(20.0 * random.uniform(trial));
    const std::uint32_t acknowledged = acknowledged_before_kill(file_, batch, n);
    EXPECT_GE(acknowledged, batch * static_cast<std::uint32_t>(n));
    const Recording recording = read_recording(file_);
    EXPECT_FALSE(recording.finished);
    EXPECT_EQ(recording.header.seed, header().seed);
    EXPECT_GE(recording.log.events.size(), acknowledged);
    EXPECT_GE(recording.estimates.size(), acknowledged);
    expect_prefix(recording);
  }
}

// Wherever a batch is torn: all batches before it are whole.
TEST_F(RecorderTest, ATornBatchCostsOnlyItself) {
  Recorder recorder(file_, header(), kStreams);
  std::vector<std::uintmax_t> sizes;
  for (std::uint32_t k = 0; k < 6; ++k) {
    recorder.record(event(k));
    recorder.record(estimate(k));
    recorder.flush();
    sizes.push_back(fs::file_size(file_));
  }
  std::ifstream whole(file_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  for (std::size_t size = sizes[0]; size < sizes.back(); size += 3) {
    const auto acknowledged =
        static_cast<std::size_t>(std::upper_bound(sizes.begin(), sizes.end(), size) - sizes.begin());
    std::istringstream cut(bytes.substr(0, size));
    const Recording recording = read_recording(cut, "cut");
    ASSERT_GE(recording.log.events.size(), acknowledged) << size;
    ASSERT_LE(recording.log.events.size(), acknowledged + 1) << size;
    expect_prefix(recording);
  }
}

// --- refusals ---------------------------------------------------------------------------------------------

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(RecorderTest, AFullDiskIsToldAtTheFlush) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(error_of([] { Recorder("/dev/full", header(), kStreams); }),
              testing::HasSubstr("No space left"));
  EXPECT_THAT(error_of([&] { Recorder(folder_ / "none" / "run.mcap", header(), kStreams); }),
              testing::HasSubstr("No such file or directory"));
}

TEST_F(RecorderTest, AnEventOfAnotherTableIsRefused) {
  Recorder recorder(file_, header(), kStreams);
  Event other = event(0);
  other.stream = 1;
  EXPECT_THAT(error_of([&] { recorder.record(other); }),
              testing::HasSubstr("does not fit the table of streams"));
}

TEST_F(RecorderTest, WhatIsNoRecordedRunIsRefused) {
  const auto read_bytes = [](const std::string& bytes) {
    std::istringstream input(bytes);
    read_recording(input, "a");
  };
  mcap::Writer other({"ros2", "other"}, mcap::Compression::kNone);
  const std::string start = other.take();
  EXPECT_THAT(error_of([&] { read_bytes(start); }), testing::HasSubstr("no recorded run"));
  EXPECT_THAT(error_of([&] { read_bytes("text"); }), testing::HasSubstr("not an MCAP file"));
  for (const char* seed : {"", "-1", "1.5", "18446744073709551616", "many"}) {
    other.add_metadata({"cairn.run", {{"seed", seed}, {"map_checksum", "1"}}});
    const std::string run = start + other.take();
    EXPECT_THAT(error_of([&] { read_bytes(run); }), testing::HasSubstr("says no seed")) << seed;
  }
}

TEST(EstimateMessage, TheFirstDifferenceIsNamedWithBothValues) {
  const Estimate a = estimate(1);
  EXPECT_FALSE(exact::first_difference(a, a).has_value());
  Estimate b = a;
  b.covariance(1, 2) = std::nextafter(0.6, 1.0);
  b.quality = 0.0;
  const auto difference = exact::first_difference(a, b).value();
  EXPECT_EQ(difference.field, "covariance_yt");
  EXPECT_EQ(difference.first, "0.6");
  EXPECT_EQ(difference.second, "0.6000000000000001");
  b = a;
  b.T_map_base.theta = 0.0;
  EXPECT_EQ(exact::first_difference(a, b).value().first, "-0");
  b = a;
  b.stamp += Duration(1);
  EXPECT_EQ(exact::first_difference(a, b).value().field, "stamp");
}

TEST(EstimateMessage, EveryCutIsMalformed) {
  const std::string bytes = exact::encode(estimate(1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(exact::decode_estimate(std::string_view(bytes).substr(0, size)), ros::MalformedMessage);
  }
}

}  // namespace
}  // namespace cairn
