#pragma once

#include "cairn/core/time.hpp"

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <utility>

namespace cairn {

/// Reads a text file line by line (LF or CRLF; a leading byte order mark is dropped) and knows where it is,
/// for error messages.
class LineReader {
 public:
  LineReader(std::istream& input, std::string name) : input_(input), name_(std::move(name)) {}

  /// Next line without its end; false at the end of the file.
  bool next();
  /// Valid until next().
  std::string_view line() const { return line_; }
  int number() const { return number_; }  ///< of the current line, from 1
  std::string where() const;              ///< "file:line"
  const std::string& name() const { return name_; }
  /// False for a last line without a line end: the file may have been cut off within it.
  bool line_was_ended() const { return line_was_ended_; }

 private:
  std::istream& input_;
  std::string name_;
  std::string line_;
  int number_ = 0;
  bool line_was_ended_ = true;
};

/// Walks over the fields of one line.
///
/// Fields are separated by runs of blanks (those named in `separators`); any other character of `separators`,
/// such as a comma, separates exactly two fields, so that ",," is a missing field and not skipped. A
/// separator at the end of the line is allowed. The typed readers throw InputError "file:line:column: what;
/// what to do" for a missing field, a word where a number belongs, NaN or infinity, and a number that the
/// type cannot hold.
/// @param meaning  what the field says ("heading"), for the message
class FieldReader {
 public:
  explicit FieldReader(const LineReader& line, std::string_view separators = " \t");

  bool at_end() const { return position_ == text_.size(); }
  std::string_view word(const char* meaning);
  double number(const char* meaning);  ///< finite; a leading '+' is allowed
  long long integer(const char* meaning);
  Time time(const char* meaning);                ///< seconds, read exactly (exponents through a double)
  double maybe_not_finite(const char* meaning);  ///< a number that may be nan or inf (a range without return)
  std::size_t fields_left() const;
  void expect_end();          ///< fails if a field is left
  std::string where() const;  ///< "file:line:column" of the field read last
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

 private:
  bool is_separator(char c) const { return separators_.find(c) != std::string_view::npos; }
  bool is_blank(char c) const { return (c == ' ' || c == '\t') && is_separator(c); }
  std::size_t skip_blanks(std::size_t position) const;
  std::size_t field_end(std::size_t position) const;
  std::size_t next_field(std::size_t end) const;
  double parse_number(const char* meaning);

  const LineReader& line_;
  std::string_view text_;
  std::string_view separators_;
  std::size_t position_ = 0;  ///< start of the next field
  std::size_t last_ = 0;      ///< start of the field read last
};

}  // namespace cairn
