#include "cairn/io/byte_stream.hpp"

#include <algorithm>
#include <limits>

namespace cairn {

std::string ByteStream::read(std::uint64_t size) {
  constexpr std::uint64_t kStep = std::uint64_t{1} << 20;
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

std::uint64_t ByteStream::size() {
  input_.clear();
  const auto here = input_.tellg();
  if (start_ < 0 || here < 0) return 0;
  input_.seekg(0, std::ios::end);
  const auto end = input_.tellg();
  input_.clear();
  input_.seekg(here);
  return end < start_ ? 0 : static_cast<std::uint64_t>(end - start_);
}

bool ByteStream::seek(std::uint64_t offset) {
  if (offset > size()) return false;
  const bool can_seek = start_ >= 0;
  if (can_seek) {
    input_.seekg(start_ + static_cast<std::streamoff>(offset));
    offset_ = offset;
  }
  return can_seek;
}

void ByteStream::skip_to_end() {
  input_.clear();
  input_.ignore(std::numeric_limits<std::streamsize>::max());
  offset_ += static_cast<std::uint64_t>(input_.gcount());
}

}  // namespace cairn
