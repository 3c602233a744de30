#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cairn::app {

/// Tells texts and files apart (FNV-1a, 64 bits): the same on every machine. It does not protect against
/// forgery.
class Fingerprint {
 public:
  /// The next text: "ab" then "c" differs from "a" then "bc".
  void add(std::string_view text);

  /// Size and content of a file; of one above 1 MiB the first and the last 512 KiB. An empty path adds
  /// nothing.
  void add_file(const std::string& path);

  /// The same with all of the content.
  void add_whole_file(const std::string& path);

  std::string text() const;  ///< 16 hexadecimal digits

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace cairn::app
