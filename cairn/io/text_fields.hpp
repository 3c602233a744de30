#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "cairn/core/time.hpp"

namespace cairn {

/// Reads a text file line by line (LF or CRLF) and knows where it is, for error messages.
class LineReader {
 public:
  LineReader(std::istream& input, std::string name) : input_(input), name_(std::move(name)) {}

  /// Next line without its end; false at the end of the file.
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }       ///< of the current line, from 1
  std::string where() const;                   ///< "file:line"
  const std::string& name() const { return name_; }

 private:
  std::istream& input_;
  std::string name_;
  std::string line_;
  int number_ = 0;
};

/// Walks over the fields of one line, separated by blanks and, if asked, commas.
///
/// The typed readers throw InputError "file:line:column: what; what to do" for a missing field, a word where a
/// number belongs, NaN or infinity.
class FieldReader {
 public:
  FieldReader(const LineReader& line, std::string_view separators = " \t");

  bool at_end();
  std::string_view word(const char* meaning);
  double number(const char* meaning);           ///< finite
  long long integer(const char* meaning);
  Time time(const char* meaning);               ///< seconds, read exactly (exponents through a double)
  double maybe_not_finite(const char* meaning); ///< a number that may be nan or inf (a range without return)
  std::size_t fields_left() const;
  std::string where() const;                    ///< "file:line:column" of the field read last
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

 private:
  const LineReader& line_;
  std::string_view separators_;
  std::size_t position_ = 0;
  std::size_t last_ = 0;
};

}  // namespace cairn
