#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace cairn {

/// Walks over packed little-endian bytes (ROS 1 messages and bag records) and never leaves them.
///
/// Reading past the end gives zeros and empty views, consumes the rest, and clears ok(): a decoder reads all
/// its fields, then asks once. A count that came from the bytes must be checked against remaining() before it
/// is used as a size.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    static_assert(std::endian::native == std::endian::little, "the formats read here are little-endian");
    Number value{};
    const std::string_view raw = take(sizeof value);
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

  /// The next `size` bytes, as they lie.
  std::string_view take(std::size_t size) {
    ok_ = ok_ && size <= remaining();
    const std::string_view taken = ok_ ? bytes_.substr(position_, size) : std::string_view();
    position_ = ok_ ? position_ + size : bytes_.size();
    return taken;
  }

  /// A block led by its length (uint32), as ROS writes strings and record parts.
  std::string_view block() { return take(number<std::uint32_t>()); }

  bool ok() const { return ok_; }
  bool at_end() const { return position_ == bytes_.size(); }
  std::size_t remaining() const { return bytes_.size() - position_; }
  std::size_t position() const { return position_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace cairn
