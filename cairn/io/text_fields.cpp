#include "cairn/io/text_fields.hpp"

#include "cairn/core/errors.hpp"

#include <charconv>
#include <cmath>

namespace cairn {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr double kMaxTimeSeconds = 9.2e9;
constexpr std::size_t kMaxQuoted = 40;

// A word as it may be shown: short, and without control characters that would upset a terminal.
std::string quoted(std::string_view word) {
  std::string shown = "'";
  for (const char c : word.substr(0, kMaxQuoted)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (word.size() > kMaxQuoted ? "...'" : "'");
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

template <typename Number>
std::errc parse(std::string_view word, Number& value) {
  word = without_plus(word);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end != word.data() + word.size() ? std::errc::invalid_argument : error;
}

}  // namespace

bool LineReader::next() {
  if (!std::getline(input_, line_)) return false;
  ++number_;
  line_was_ended_ = !input_.eof();
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  if (number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
  return true;
}

std::string LineReader::where() const { return name_ + ":" + std::to_string(number_); }

FieldReader::FieldReader(const LineReader& line, std::string_view separators)
    : line_(line), text_(line.line()), separators_(separators), position_(skip_blanks(0)) {}

std::size_t FieldReader::skip_blanks(std::size_t position) const {
  while (position < text_.size() && is_blank(text_[position])) ++position;
  return position;
}

std::size_t FieldReader::field_end(std::size_t position) const {
  while (position < text_.size() && !is_separator(text_[position])) ++position;
  return position;
}

std::size_t FieldReader::next_field(std::size_t end) const {
  const std::size_t position = skip_blanks(end);
  const bool at_comma = position < text_.size() && is_separator(text_[position]);
  return at_comma ? skip_blanks(position + 1) : position;
}

std::string_view FieldReader::word(const char* meaning) {
  last_ = position_;
  if (at_end()) fail(std::string("the line ends where the ") + meaning + " belongs", "complete the line");
  const std::size_t end = field_end(position_);
  if (end == position_) fail(std::string("empty field where the ") + meaning + " belongs", "fill it in");
  position_ = next_field(end);
  return text_.substr(last_, end - last_);
}

double FieldReader::parse_number(const char* meaning) {
  const std::string_view text = word(meaning);
  double value = 0.0;
  const std::errc error = parse(text, value);
  if (error == std::errc::result_out_of_range) {
    fail(std::string(meaning) + " " + quoted(text) + " is beyond what a double holds", "check the value");
  }
  if (error != std::errc()) {
    fail(quoted(text) + " stands where the " + meaning + " belongs", "write a number there");
  }
  return value;
}

double FieldReader::maybe_not_finite(const char* meaning) { return parse_number(meaning); }

double FieldReader::number(const char* meaning) {
  const double value = parse_number(meaning);
  if (!std::isfinite(value)) fail(std::string(meaning) + " is not finite", "write a finite number there");
  return value;
}

long long FieldReader::integer(const char* meaning) {
  const std::string_view text = word(meaning);
  long long value = 0;
  if (parse(text, value) != std::errc()) {
    fail(quoted(text) + " stands where the " + meaning + " belongs", "write a whole number there");
  }
  return value;
}

Time FieldReader::time(const char* meaning) {
  const std::size_t start = position_;
  if (const auto exact = parse_time(word(meaning))) return *exact;
  position_ = start;
  const double seconds = number(meaning);
  if (std::abs(seconds) > kMaxTimeSeconds) {
    fail(std::string(meaning) + " is more than 292 years from zero", "write it in seconds");
  }
  return time_from_seconds(seconds);
}

std::size_t FieldReader::fields_left() const {
  std::size_t count = 0;
  for (std::size_t at = position_; at < text_.size(); at = next_field(field_end(at))) ++count;
  return count;
}

void FieldReader::expect_end() {
  if (at_end()) return;
  last_ = position_;
  fail("more fields than the line announces or its message has", "remove them or correct the count");
}

std::string FieldReader::where() const { return line_.where() + ":" + std::to_string(last_ + 1); }

void FieldReader::fail(const std::string& what, const std::string& remedy) const {
  throw InputError(where(), what, remedy);
}

}  // namespace cairn
