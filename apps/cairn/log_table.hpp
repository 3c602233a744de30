#pragma once

#include "cairn/io/log_summary.hpp"

#include <string>

namespace cairn::app {

/// The summary as tables for a terminal: streams, lasers, odometry, and what the reader warned about.
std::string log_table(const LogSummary& summary);

}  // namespace cairn::app
