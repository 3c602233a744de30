#pragma once

#include "cairn/core/time.hpp"
#include "cairn/io/byte_reader.hpp"
#include "cairn/io/byte_stream.hpp"

#include <cstdint>
#include <cstring>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

/// The container of ROS 1 bags, format 2.0 (http://wiki.ros.org/Bags/Format/2.0): after a first line,
/// records of `<uint32 n><header: n bytes><uint32 m><data: m bytes>`, all little-endian. A header is a
/// sequence of `<uint32 k><name=value: k bytes>`; its field `op` tells what the record is.
namespace cairn::rosbag1 {

inline constexpr std::string_view kFirstLine = "#ROSBAG V2.0\n";
inline constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;   ///< longer: the length is damaged
inline constexpr std::size_t kMaxChunkBytes = std::size_t{256} << 20;  ///< unpacked; rosbag writes < 1 MiB

enum class Op : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// Value of a header field; nullopt if it is not there (or the header is damaged before it).
std::optional<std::string_view> header_field(std::string_view header, std::string_view name);

/// A header field of exactly the width of Number.
template <class Number>
std::optional<Number> header_number(std::string_view header, std::string_view name) {
  const auto value = header_field(header, name);
  if (!value || value->size() != sizeof(Number)) return std::nullopt;
  return ByteReader(*value).number<Number>();
}

std::optional<Op> header_op(std::string_view header);

/// ROS time: whole seconds and nanoseconds, uint32 each.
inline Time ros_time(std::uint32_t seconds, std::uint32_t nanoseconds) {
  return Time(std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds));
}

/// One record that lies in memory (within a chunk).
struct RecordView {
  std::string_view header;
  std::string_view data;
};

/// Takes the next record; nullopt if the bytes end within it (then `bytes` is not ok any more).
std::optional<RecordView> next_record(ByteReader& bytes);

/// Reads the records of a bag one by one from a stream, wherever in it the bag begins.
class RecordStream {
 public:
  enum class Status {
    kRecord,
    kEnd,       ///< the stream ended between two records
    kCutShort,  ///< the stream ended within a record: header() and data() hold what was there
    kDamaged    ///< no record here: an impossible header length, or a header without `op`
  };

  explicit RecordStream(std::istream& input) : input_(input) {}

  /// Reads `size` bytes (fewer at the end of the stream).
  std::string bytes(std::size_t size) { return input_.read(size); }

  Status next();
  RecordView record() const { return {header_, data_}; }
  std::uint64_t record_offset() const { return record_offset_; }  ///< where the last record began
  std::uint64_t offset() const { return input_.offset(); }        ///< bytes from the bag's begin
  std::uint64_t missing_bytes() const { return missing_bytes_; }  ///< kCutShort: known to be lost

  bool seek(std::uint64_t offset) { return input_.seek(offset); }  ///< see ByteStream
  void skip_to_end() { input_.skip_to_end(); }

 private:
  bool read_part(std::string& part, std::size_t limit);

  ByteStream input_;
  std::uint64_t record_offset_ = 0;
  std::uint64_t missing_bytes_ = 0;
  std::string header_;
  std::string data_;
};

}  // namespace cairn::rosbag1
