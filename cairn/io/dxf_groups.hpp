#pragma once

#include "cairn/io/text_fields.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Reads an ASCII DXF file group by group: a line with a code, a line with its value.
class DxfGroups {
 public:
  DxfGroups(std::istream& input, const std::string& name) : line_(input, name) {}

  /// Goes to the next group but comments (999); false at the end of the file.
  /// @throws InputError file:line for a code that is no number, or a code without value
  bool next();
  int code() const { return code_; }
  const std::string& value() const { return value_; }
  bool is(int code, const char* value) const { return code_ == code && value_ == value; }

  /// The value as a finite number, or an integer. @throws InputError file:line
  double number() const;
  long long integer() const;

  std::string where() const { return line_.where(); }
  int line_number() const { return line_.number(); }
  const std::string& name() const { return line_.name(); }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

 private:
  LineReader line_;
  int code_ = 0;
  std::string value_;
};

}  // namespace cairn
