#pragma once

#include "cairn/io/byte_reader.hpp"
#include "cairn/io/ros_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Common Data Representation (OMG DDS-XTypes 1.3, section 7.4, "plain CDR, version 1"), the serialisation of
/// ROS 2 messages: four bytes that tell the byte order, then the fields one after the other, each number
/// aligned to its own size counted from byte 4.
namespace cairn::cdr {

enum class ByteOrder : std::uint8_t { kBig = 0, kLittle = 1 };

inline constexpr std::size_t kHeaderBytes = 4;

/// Number with its bytes in the other order.
template <class Number>
Number swapped(Number value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

/// Walks over a message and never leaves it: as in ByteReader, what is missing reads as zero and clears ok().
class Reader {
 public:
  /// @throws ros::MalformedMessage unless the header is that of plain CDR, version 1
  explicit Reader(std::string_view message) : bytes_(message) {
    const std::string_view header = bytes_.take(kHeaderBytes);
    const bool is_plain = bytes_.ok() && header[0] == 0 && (header[1] == 0 || header[1] == 1);
    ros::require(is_plain, "it is not plain CDR (of a ROS 2 message)");
    swap_ = static_cast<ByteOrder>(header[1]) == ByteOrder::kBig;
  }

  template <class Number>
  Number number() {
    align(sizeof(Number));
    const auto value = bytes_.number<Number>();
    return swap_ ? swapped(value) : value;
  }

  /// Without the NUL at its end.
  std::string_view text() {
    std::string_view text = bytes_.take(number<std::uint32_t>());
    if (text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  /// Length of a sequence whose elements take at least `element_bytes` each.
  /// @throws ros::MalformedMessage if the message cannot hold that many
  std::size_t length(std::size_t element_bytes) {
    const std::size_t count = number<std::uint32_t>();
    ros::require(bytes_.ok() && count <= bytes_.remaining() / element_bytes,
                 "it announces more than it holds");
    return count;
  }

  template <class Number>
  std::vector<Number> numbers() {
    std::vector<Number> values(length(sizeof(Number)));
    if (!values.empty()) align(sizeof(Number));
    const std::string_view raw = bytes_.take(values.size() * sizeof(Number));
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    if (swap_) std::transform(values.begin(), values.end(), values.begin(), swapped<Number>);
    return values;
  }

  /// Goes over `count` numbers of `size` bytes each.
  void skip(std::size_t count, std::size_t size) {
    align(size);
    bytes_.take(count * size);
  }

  bool ok() const { return bytes_.ok(); }

 private:
  void align(std::size_t size) {
    const std::size_t beyond = (bytes_.position() - kHeaderBytes) % size;
    if (beyond > 0) bytes_.take(size - beyond);
  }

  ByteReader bytes_;
  bool swap_ = false;
};

/// Writes a message.
class Writer {
 public:
  explicit Writer(ByteOrder order = ByteOrder::kLittle)
      : bytes_{'\0', static_cast<char>(order), '\0', '\0'}, swap_(order == ByteOrder::kBig) {}

  template <class Number>
  Writer& number(Number value) {
    align(sizeof(Number));
    if (swap_) value = swapped(value);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }

  /// @throws ros::MalformedMessage for 4 GiB and more, as numbers()
  Writer& text(std::string_view text) {
    length(text.size() + 1);
    bytes_.append(text).push_back('\0');
    return *this;
  }

  Writer& length(std::size_t count) {
    ros::require(count <= UINT32_MAX, "it is too long for a message");
    return number(static_cast<std::uint32_t>(count));
  }

  template <class Number>
  Writer& numbers(std::span<const Number> values) {
    length(values.size());
    if (swap_) {
      for (const Number value : values) number(value);
    } else if (!values.empty()) {
      align(sizeof(Number));
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }
    return *this;
  }

  const std::string& bytes() const& { return bytes_; }
  std::string bytes() && { return std::move(bytes_); }

 private:
  void align(std::size_t size) {
    const std::size_t beyond = (bytes_.size() - kHeaderBytes) % size;
    if (beyond > 0) bytes_.append(size - beyond, '\0');
  }

  std::string bytes_;
  bool swap_;
};

}  // namespace cairn::cdr
