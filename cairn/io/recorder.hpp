#pragma once

#include "cairn/io/append_file.hpp"
#include "cairn/io/event_writer.hpp"
#include "cairn/localization/estimate.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// All that a run depends on but its events: with it and them, the run can be had again.
struct RunHeader {
  std::string cairn_version;
  std::string configuration;  ///< YAML, as write_configuration gives it
  std::uint64_t seed = 1;
  std::optional<Pose2> T_map_base;  ///< the start pose; nullopt: anywhere
  std::string map_path;
  std::uint64_t map_checksum = 0;  ///< cairn::checksum of the map, in all that was read of it
  std::string log_path;            ///< what was localized; empty for a robot
  std::string odometry_stream;     ///< that becomes tf odom -> base_link; empty: the first
  /// Of the maps that single streams have for themselves (streams.<name>.map), by their paths.
  std::map<std::string, std::uint64_t> stream_map_checksums = {};
  /// The estimates are those that the robot had at each moment, rather than one per measurement.
  bool live = false;
};

struct RecorderOptions {
  mcap::Compression compression = mcap::Compression::kLz4;
  std::size_t batch_bytes = std::size_t{1} << 16;  ///< record() flushes by itself beyond this
  bool sync = false;                               ///< flush() waits until the disk has it
};

/// Writes a run into one MCAP file while it happens: every event with its arrival before the localizer takes
/// it, every estimate when it comes. Foxglove and ROS 2 tools open the file as it is (event_writer.hpp; the
/// estimates are /cairn/pose and tf map -> odom), read_recording and `cairn replay` take it exactly.
///
/// What flush() has acknowledged by returning is in the file whatever becomes of the process (kill -9), and
/// the file opens: it lacks its index, which readers do without. With `sync` it outlives a loss of power,
/// too, at the price of one wait for the disk per flush.
///
/// A flush makes one chunk. A robot should flush some ten times per second rather than for every event: a
/// chunk takes about 200 bytes of memory until the file is finished, and small ones pack badly.
class Recorder {
 public:
  /// Begins the file; header and streams are acknowledged when it returns.
  /// @throws InputError where the disk refuses, as all functions below
  Recorder(const std::filesystem::path& path, const RunHeader& header, const std::vector<StreamInfo>& streams,
           const RecorderOptions& options = {});

  /// @throws InputError also for an event that does not fit the table of streams
  void record(const Event& event);
  void record(const Estimate& estimate);
  void flush();

  /// Flushes, says that the run came to its end, and closes the file with its index. Nothing may follow.
  void finish();

 private:
  void flush_full_batch();
  void store();

  RecorderOptions options_;
  AppendFile file_;
  mcap::Writer writer_;
  EventWriter events_;
  std::uint16_t estimate_channel_;
  std::uint16_t pose_channel_;
  std::uint32_t estimates_ = 0;
};

}  // namespace cairn
