#pragma once

#include "cairn/core/time.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cairn::app {

/// Spans of a log, in seconds since its first event: the start belongs to a span, the end does not.
class TimeSpans {
 public:
  /// @param text  "0-300,600-900"; empty: everything
  /// @throws ConfigurationError unless each span is two numbers, the first below the second
  TimeSpans(const std::string& option, const std::string& text);

  bool everything() const { return spans_.empty(); }
  bool contains(Duration since_start) const;

 private:
  std::vector<std::pair<double, double>> spans_;
};

}  // namespace cairn::app
