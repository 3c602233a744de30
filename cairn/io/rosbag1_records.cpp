#include "cairn/io/rosbag1_records.hpp"

#include <algorithm>
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

std::string RecordStream::bytes(std::size_t size) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  std::string result;
  while (result.size() < size && input_) {
    const std::size_t before = result.size();
    result.resize(before + std::min(kStep, size - before));
    input_.read(result.data() + before, static_cast<std::streamsize>(result.size() - before));
    result.resize(before + static_cast<std::size_t>(input_.gcount()));
  }
  offset_ += result.size();
  return result;
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
  record_offset_ = offset_;
  const bool has_header = read_part(header_, kMaxHeaderBytes);
  if (!has_header && offset_ == record_offset_) return Status::kEnd;
  if (!has_header) return missing_bytes_ > 0 ? Status::kCutShort : Status::kDamaged;
  if (!header_op(header_)) return Status::kDamaged;
  return read_part(data_, std::numeric_limits<std::uint32_t>::max()) ? Status::kRecord : Status::kCutShort;
}

bool RecordStream::seek(std::uint64_t offset) {
  input_.clear();
  const auto here = input_.tellg();
  if (start_ < 0 || here < 0 || offset > std::uint64_t{1} << 62) return false;
  input_.seekg(0, std::ios::end);
  const auto end = input_.tellg();
  const bool possible = end >= 0 && offset <= static_cast<std::uint64_t>(end - start_);
  input_.clear();
  input_.seekg(possible ? start_ + static_cast<std::streamoff>(offset) : here);
  if (possible) offset_ = offset;
  return possible;
}

void RecordStream::skip_to_end() {
  input_.clear();
  input_.ignore(std::numeric_limits<std::streamsize>::max());
  offset_ += static_cast<std::uint64_t>(input_.gcount());
}

}  // namespace cairn::rosbag1
