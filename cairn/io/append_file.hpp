#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace cairn {

/// A file that only grows. What append() has taken is in the hands of the operating system when it returns:
/// it outlives this process, however that dies. sync() makes it outlive the machine, too.
class AppendFile {
 public:
  /// Makes the file, or empties the one that is there.
  /// @throws InputError if that is not possible
  explicit AppendFile(std::filesystem::path path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// All or nothing. @throws InputError if the disk refuses; then the file ends where it ended before.
  void append(std::string_view bytes);
  /// @throws InputError if the disk refuses
  void sync();

 private:
  [[noreturn]] void refuse(int error) const;

  std::filesystem::path path_;
  int file_;
  std::int64_t size_ = 0;
};

}  // namespace cairn
