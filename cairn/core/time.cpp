#include "cairn/core/time.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace cairn {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kMaxSeconds = 9'200'000'000;

// "3375" -> 337500000: digits after the point as nanoseconds; nullopt if one is no digit.
std::optional<std::int64_t> parse_fraction(std::string_view digits) {
  std::int64_t nanoseconds = 0;
  for (std::size_t i = 0; i < digits.size() || i < 9; ++i) {
    const char digit = i < digits.size() ? digits[i] : '0';
    if (digit < '0' || digit > '9') return std::nullopt;
    if (i < 9) nanoseconds = nanoseconds * 10 + (digit - '0');
  }
  return nanoseconds;
}

std::optional<std::int64_t> parse_whole(std::string_view digits) {
  if (digits.empty()) return 0;
  if (digits.front() == '-' || digits.front() == '+') return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || value > kMaxSeconds)
    return std::nullopt;
  return value;
}

}  // namespace

Duration duration_from_seconds(double seconds) {
  // Whole seconds apart, so that a large epoch does not cost digits of the fraction.
  const double whole = std::floor(seconds);
  return Duration(static_cast<std::int64_t>(whole) * kNanosecondsPerSecond +
                  std::llround((seconds - whole) * 1e9));
}

Time time_from_seconds(double seconds) { return Time(duration_from_seconds(seconds)); }

double to_seconds(Duration duration) { return static_cast<double>(duration.count()) * 1e-9; }

double to_seconds(Time time) { return to_seconds(time.time_since_epoch()); }

std::optional<Time> parse_time(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative || (!text.empty() && text.front() == '+')) text.remove_prefix(1);
  const std::size_t point = text.find('.');
  const std::string_view fraction_digits = point == std::string_view::npos ? "" : text.substr(point + 1);
  const auto whole = parse_whole(text.substr(0, point));
  const auto fraction = parse_fraction(fraction_digits);
  const bool has_digit = (point == std::string_view::npos ? text.size() : text.size() - 1) > 0;
  if (!whole || !fraction || !has_digit) return std::nullopt;
  const std::int64_t nanoseconds = *whole * kNanosecondsPerSecond + *fraction;
  return Time(Duration(negative ? -nanoseconds : nanoseconds));
}

std::string format_time(Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  const auto magnitude = count < 0 ? -static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  char text[40];
  std::snprintf(text, sizeof text, "%s%llu.%09llu", count < 0 ? "-" : "",
                static_cast<unsigned long long>(magnitude / kNanosecondsPerSecond),
                static_cast<unsigned long long>(magnitude % kNanosecondsPerSecond));
  return text;
}

}  // namespace cairn
