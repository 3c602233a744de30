#pragma once

#include <stdexcept>
#include <string>

namespace cairn {

/// Input (a file, a message) that cannot be used. The text is one sentence: "where: what; what to do".
class InputError : public std::runtime_error {
 public:
  /// @param where   file:line:column, file (byte offset N), or key
  /// @param what    what is wrong there
  /// @param remedy  what the user can do about it; may be empty
  InputError(const std::string& where, const std::string& what, const std::string& remedy);

  const std::string& where() const { return where_; }

 private:
  std::string where_;
};

/// A configuration or command line that cannot be used (exit code 2 rather than 3).
class ConfigurationError : public InputError {
 public:
  using InputError::InputError;
};

namespace detail {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);
}

/// A condition that only a bug in Cairn can break. Throws std::logic_error: the library never aborts.
#define CAIRN_ASSERT(expression) \
  ((expression) ? static_cast<void>(0) : ::cairn::detail::assertion_failed(#expression, __FILE__, __LINE__))

}  // namespace cairn
