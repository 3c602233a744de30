#pragma once

#include "cairn/io/log.hpp"
#include "cairn/io/mcap_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace cairn {

/// Collects the streams and events that a recording of Cairn holds exactly (exact_messages.hpp).
class ExactLog {
 public:
  enum class Values : std::uint8_t {
    kAsRecorded,  ///< whatever came, NaN too: what a replay must see again
    kChecked      ///< what a reader may hand out: finite poses, scans that make sense
  };

  ExactLog(std::string name, Values values);

  /// Takes note if it is a channel of exact events.
  void add_channel(const mcap::Channel& channel);
  /// True if the message was one of them, taken or malformed.
  bool add_message(const mcap::MessageView& message);
  /// True for a channel that says the same in ROS's words, for other tools.
  bool is_twin(const mcap::Channel& channel) const;

  bool has_streams() const { return !streams_.empty(); }
  Log finish() &&;

  /// Metadata of a channel that repeats exact messages.
  static const mcap::Texts& twin_mark();

 private:
  void add_event(Event event, std::uint64_t offset, std::size_t bytes);

  std::string name_;
  Values values_;
  std::size_t bytes_left_;
  Log log_;
  std::map<std::uint16_t, StreamId> streams_;  // by channel
};

}  // namespace cairn
