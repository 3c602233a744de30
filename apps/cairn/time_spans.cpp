#include "apps/cairn/time_spans.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace cairn::app {
namespace {

bool parse(const std::string& text, double& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

}  // namespace

TimeSpans::TimeSpans(const std::string& option, const std::string& text) {
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t dash = part.find('-');
    double from = 0.0, to = 0.0;
    const bool good =
        dash != std::string::npos && parse(part.substr(0, dash), from) && parse(part.substr(dash + 1), to);
    if (!good || !(from >= 0.0 && from < to && to < 1e12)) {
      throw ConfigurationError(option, "'" + part + "' is no span of time",
                               "write seconds since the log's start, for example 0-300,600-900");
    }
    spans_.emplace_back(from, to);
  }
}

bool TimeSpans::contains(Duration since_start) const {
  const double s = to_seconds(since_start);
  return everything() || std::any_of(spans_.begin(), spans_.end(),
                                     [&](const auto& span) { return s >= span.first && s < span.second; });
}

}  // namespace cairn::app
