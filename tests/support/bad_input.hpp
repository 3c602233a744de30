#pragma once

#include "cairn/core/errors.hpp"

#include <functional>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace cairn::test {

/// Reads `bytes`; true if the reader took them, false if it threw an InputError. Anything else thrown fails
/// the test.
inline bool is_accepted(const std::function<void(std::istream&)>& read, const std::string& bytes) {
  std::istringstream input(bytes);
  try {
    read(input);
    return true;
  } catch (const InputError& error) {
    EXPECT_STRNE(error.what(), "");
    return false;
  }
}

/// Text of the InputError that `read` throws on `bytes`; "accepted" if it throws none.
inline std::string error_on(const std::function<void(std::istream&)>& read, const std::string& bytes) {
  std::istringstream input(bytes);
  try {
    read(input);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Cuts `bytes` at every length: each cut must be read or be refused by an InputError, never anything else.
/// Returns how many cuts were accepted.
inline std::size_t accepted_cuts(const std::function<void(std::istream&)>& read, const std::string& bytes) {
  std::size_t accepted = 0;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    accepted += is_accepted(read, bytes.substr(0, length)) ? 1 : 0;
  }
  return accepted;
}

}  // namespace cairn::test
