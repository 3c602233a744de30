#include "cairn/io/append_file.hpp"

#include "cairn/core/errors.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace cairn {

AppendFile::AppendFile(std::filesystem::path path)
    : path_(std::move(path)), file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) refuse(errno);
}

AppendFile::~AppendFile() { close(file_); }

void AppendFile::refuse(int error) const {
  throw InputError(path_.string(), "cannot be written: " + std::generic_category().message(error),
                   "check the folder, its permissions and the space there");
}

void AppendFile::append(std::string_view bytes) {
  const std::int64_t end = size_ + static_cast<std::int64_t>(bytes.size());
  while (!bytes.empty()) {
    const ssize_t written = write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      // Half a record would hide all that follows it. If this fails, too, readers tell where the file breaks.
      static_cast<void>(ftruncate(file_, size_) == 0 && lseek(file_, size_, SEEK_SET) == size_);
      refuse(error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ = end;
}

void AppendFile::sync() {
  if (fdatasync(file_) != 0) refuse(errno);
}

}  // namespace cairn
