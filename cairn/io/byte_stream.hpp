#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace cairn {

/// The bytes of a file from where a stream stands, for readers of records. Memory grows with what really
/// comes, whatever a record announces.
class ByteStream {
 public:
  explicit ByteStream(std::istream& input) : input_(input), start_(input.tellg()) {}

  /// Reads `size` bytes, fewer at the end of the stream.
  std::string read(std::uint64_t size);
  std::uint64_t offset() const { return offset_; }  ///< bytes from where the stream stood

  /// Goes to an offset, if the stream can and is that long. After a failure it stands where it stood.
  bool seek(std::uint64_t offset);
  /// Length from where the stream stood; 0 if it cannot seek.
  std::uint64_t size();
  void skip_to_end();

 private:
  std::istream& input_;
  std::istream::pos_type start_;
  std::uint64_t offset_ = 0;
};

}  // namespace cairn
