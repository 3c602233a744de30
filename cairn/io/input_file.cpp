#include "cairn/io/input_file.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/unpack.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace cairn {
namespace {

constexpr std::size_t kFirstReadBytes = std::size_t{1} << 20;

void check_can_be_opened(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError(path.string(), "no such file", "check the path");
  }
  if (error)
    throw InputError(path.string(), "cannot be looked at: " + error.message(), "check its permissions");
  if (std::filesystem::is_directory(status)) {
    throw InputError(path.string(), "is a directory", "name a file in it");
  }
}

std::size_t first_guess_of_size(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);  // fails for a pipe
  return error ? kFirstReadBytes : static_cast<std::size_t>(size) + 1;
}

// Up to one byte more than the limit, so that going beyond it is noticed even if the file has no size (a
// pipe).
std::string read_whole(const std::filesystem::path& path, std::size_t max_bytes) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(path.string(), "cannot be opened: " + std::generic_category().message(errno),
                     "check its permissions");
  }
  std::string bytes;
  std::size_t size = 0;
  std::size_t wanted = std::min(first_guess_of_size(path), max_bytes + 1);
  while (size < wanted) {
    bytes.resize(wanted);
    file.read(bytes.data() + size, static_cast<std::streamsize>(wanted - size));
    const auto count = static_cast<std::size_t>(file.gcount());
    size += count;
    if (file) wanted = std::min(2 * wanted, max_bytes + 1);
    if (!file) wanted = size;
  }
  if (file.bad())
    throw InputError(path.string() + " (byte " + std::to_string(size) + ")", "reading failed", "");
  bytes.resize(size);
  return bytes;
}

std::string unpack(std::string bytes, const std::string& name, std::size_t max_bytes) {
  switch (packing_of(bytes)) {
    case Packing::kGzip:
      return unpack_gzip(bytes, name, max_bytes);
    case Packing::kBzip2:
      return unpack_bzip2(bytes, name, max_bytes);
    case Packing::kZstd:
      return unpack_zstd(bytes, name, max_bytes);
    case Packing::kNone:
      break;
  }
  return bytes;
}

}  // namespace

std::unique_ptr<std::istream> open_input(const std::filesystem::path& path, std::size_t max_bytes) {
  check_can_be_opened(path);
  std::string bytes = read_whole(path, max_bytes);
  if (bytes.size() > max_bytes) {
    throw InputError(path.string(), "holds more than " + std::to_string(max_bytes) + " bytes",
                     "split the file");
  }
  bytes = unpack(std::move(bytes), path.string(), max_bytes);
  if (bytes.empty()) throw InputError(path.string(), "is empty", "check how the file was made");
  return std::make_unique<std::istringstream>(std::move(bytes), std::ios::in | std::ios::binary);
}

}  // namespace cairn
