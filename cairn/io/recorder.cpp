#include "cairn/io/recorder.hpp"

#include "cairn/io/estimate_message.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/recording_format.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/ros2_schemas.hpp"

namespace cairn {
namespace {

constexpr const char* kMapFrame = "map";
constexpr const char* kOdometryFrame = "odom";

mcap::Metadata to_metadata(const RunHeader& header) {
  mcap::Metadata metadata{recording::kRun,
                          {{recording::kVersion, header.cairn_version},
                           {recording::kConfiguration, header.configuration},
                           {recording::kSeed, std::to_string(header.seed)},
                           {recording::kMap, header.map_path},
                           {recording::kMapChecksum, std::to_string(header.map_checksum)},
                           {recording::kLog, header.log_path},
                           {recording::kOdometry, header.odometry_stream}}};
  for (const auto& [path, checksum] : header.stream_map_checksums) {
    metadata.values[recording::kStreamMap + path] = std::to_string(checksum);
  }
  if (header.live) metadata.values[recording::kLive] = "true";
  if (header.T_map_base) metadata.values[recording::kStart] = exact::to_text(*header.T_map_base);
  return metadata;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const RunHeader& header,
                   const std::vector<StreamInfo>& streams, const RecorderOptions& options)
    : options_(options),
      file_(path),
      writer_(recording_header(), options.compression),
      events_(writer_, streams, header.odometry_stream),
      estimate_channel_(
          writer_.add_channel(writer_.add_schema(exact::kEstimate, "ros2msg", exact::estimate_schema()),
                              recording::kEstimateTopic, "cdr")),
      pose_channel_(events_.add_ros_channel(recording::kPoseTopic, ros2::kPose)) {
  writer_.add_metadata(to_metadata(header));
  flush();
}

void Recorder::record(const Event& event) {
  events_.add(event);
  flush_full_batch();
}

void Recorder::record(const Estimate& estimate) {
  const Time arrival = events_.last_arrival();
  const std::uint32_t number = estimates_++;
  writer_.add_message({estimate_channel_, number, mcap::to_mcap(arrival), mcap::to_mcap(estimate.stamp),
                       exact::encode(estimate)});
  const std::string pose =
      ros2::encode_pose({estimate.stamp, kMapFrame}, estimate.T_map_base, estimate.covariance);
  events_.add_ros_message(pose_channel_, number, arrival, estimate.stamp, pose);
  ros::StampedTransform transform;
  transform.header = {estimate.stamp, kMapFrame};
  transform.child_frame_id = kOdometryFrame;
  transform.T_parent_child = ros2::rigid(estimate.T_map_odom);
  events_.add_transform(number, arrival, transform);
  flush_full_batch();
}

void Recorder::flush_full_batch() {
  if (writer_.open_bytes() >= options_.batch_bytes) flush();
}

void Recorder::flush() {
  writer_.end_chunk();
  store();
}

void Recorder::store() {
  file_.append(writer_.take());
  if (options_.sync) file_.sync();
}

void Recorder::finish() {
  writer_.end_chunk();
  writer_.add_metadata({recording::kEnd,
                        {{recording::kEvents, std::to_string(events_.events())},
                         {recording::kEstimates, std::to_string(estimates_)}}});
  writer_.finish();
  store();
}

}  // namespace cairn
