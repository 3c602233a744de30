#include "cairn/core/errors.hpp"

namespace cairn {

InputError::InputError(const std::string& where, const std::string& what, const std::string& remedy)
    : std::runtime_error(where + ": " + what + (remedy.empty() ? "" : "; " + remedy)), where_(where) {}

namespace detail {

void assertion_failed(const char* expression, const char* file, int line) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": a bug in Cairn: " + expression +
                         " does not hold; please report it");
}

}  // namespace detail
}  // namespace cairn
