#include "cairn/io/rosbag1_records.hpp"

#include <limits>

namespace cairn::rosbag1 {

std::optional<std::string_view> header_field(std::string_view header, std::string_view name) {
  ByteReader fields(header);
  while (!fields.at_end()) {
    const std::string_view field = fields.block();
    const std::size_t equals = field.find('=');
    if (!fields.ok() || equals == std::string_view::npos) return std::nullopt;
    if (field.substr(0, equals) == name) return field.substr(equals + 1);
  }
  return std::nullopt;
}

std::optional<Op> header_op(std::string_view header) {
  const auto op = header_number<std::uint8_t>(header, "op");
  return op ? std::optional(static_cast<Op>(*op)) : std::nullopt;
}

std::optional<RecordView> next_record(ByteReader& bytes) {
  const RecordView record{bytes.block(), bytes.block()};  // braces: in this order
  return bytes.ok() ? std::optional(record) : std::nullopt;
}

// Length and bytes of a header or of data; false if the stream ends before or the length exceeds the limit.
bool RecordStream::read_part(std::string& part, std::size_t limit) {
  const std::string raw = bytes(sizeof(std::uint32_t));
  const std::size_t size = ByteReader(raw).number<std::uint32_t>();
  missing_bytes_ = sizeof(std::uint32_t) - raw.size();
  if (missing_bytes_ > 0 || size > limit) return false;
  part = bytes(size);
  missing_bytes_ = size - part.size();
  return missing_bytes_ == 0;
}

RecordStream::Status RecordStream::next() {
  header_.clear();
  data_.clear();
  record_offset_ = offset();
  const bool has_header = read_part(header_, kMaxHeaderBytes);
  if (!has_header && offset() == record_offset_) return Status::kEnd;
  if (!has_header) return missing_bytes_ > 0 ? Status::kCutShort : Status::kDamaged;
  if (!header_op(header_)) return Status::kDamaged;
  return read_part(data_, std::numeric_limits<std::uint32_t>::max()) ? Status::kRecord : Status::kCutShort;
}

}  // namespace cairn::rosbag1
