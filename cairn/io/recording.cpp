#include "cairn/io/recording.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/estimate_message.hpp"
#include "cairn/io/exact_log.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/recording_format.hpp"
#include "cairn/io/ros_messages.hpp"

#include <charconv>

namespace cairn {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name, what, "give a run.mcap that `cairn localize` has written, or its folder");
}

std::uint64_t number(const std::string& name, const mcap::Texts& texts, const std::string& key) {
  const auto found = texts.find(key);
  std::uint64_t value = 0;
  const char* const begin = found == texts.end() ? nullptr : found->second.data();
  const char* const end = begin == nullptr ? nullptr : begin + found->second.size();
  const auto parsed = std::from_chars(begin, end, value);
  if (begin == end || parsed.ec != std::errc() || parsed.ptr != end) {
    refuse(name, "says no " + key + " of the run");
  }
  return value;
}

std::map<std::string, std::uint64_t> stream_map_checksums(const std::string& name, const mcap::Texts& texts) {
  const std::string prefix = recording::kStreamMap;
  std::map<std::string, std::uint64_t> checksums;
  for (const auto& [key, text] : texts) {
    if (key.starts_with(prefix)) checksums[key.substr(prefix.size())] = number(name, texts, key);
  }
  return checksums;
}

RunHeader to_header(const std::string& name, const mcap::Texts& texts) {
  const auto text = [&](const char* key) {
    const auto found = texts.find(key);
    return found == texts.end() ? std::string() : found->second;
  };
  RunHeader header;
  header.cairn_version = text(recording::kVersion);
  header.configuration = text(recording::kConfiguration);
  header.seed = number(name, texts, recording::kSeed);
  header.map_path = text(recording::kMap);
  header.map_checksum = number(name, texts, recording::kMapChecksum);
  header.log_path = text(recording::kLog);
  header.odometry_stream = text(recording::kOdometry);
  header.stream_map_checksums = stream_map_checksums(name, texts);
  header.live = texts.contains(recording::kLive);
  if (!texts.contains(recording::kStart)) return header;
  header.T_map_base = exact::to_pose(text(recording::kStart));
  if (!header.T_map_base) refuse(name, "says no start pose of the run that can be read");
  return header;
}

}  // namespace

Recording read_recording(std::istream& input, const std::string& name) {
  Recording result;
  ExactLog events(name, ExactLog::Values::kAsRecorded);
  Diagnostics diagnostics;
  bool has_header = false;
  mcap::Handlers handlers;
  handlers.on_channel = [&](const mcap::Schema&, const mcap::Channel& channel) {
    events.add_channel(channel);
  };
  handlers.on_metadata = [&](const mcap::Metadata& metadata) {
    if (metadata.name == recording::kEnd) result.finished = true;
    if (metadata.name != recording::kRun) return;
    result.header = to_header(name, metadata.values);
    has_header = true;
  };
  handlers.on_message = [&](const mcap::MessageView& m) {
    if (events.add_message(m) || m.schema.name != exact::kEstimate) return;
    try {
      result.estimates.push_back(exact::decode_estimate(m.message.data));
    } catch (const ros::MalformedMessage& error) {
      diagnostics.warn("malformed message", name + " (byte offset " + std::to_string(m.offset) + ")",
                       error.what());
    }
  };
  mcap::read(input, name, handlers, diagnostics);
  if (!has_header) refuse(name, "is an MCAP file, but no recorded run");
  result.log = std::move(events).finish();
  result.log.format = "cairn_mcap";
  result.log.diagnostics.add(diagnostics);
  return result;
}

Recording read_recording(const std::filesystem::path& path) {
  return read_recording(*open_input(path), path.string());
}

}  // namespace cairn
