#pragma once

#include "cairn/io/log.hpp"

#include <string>

namespace cairn {

/// Counts a warning "implausible units" per stream whose numbers cannot be metres and seconds: more than half
/// of the finite, positive ranges beyond 100 m, or a median speed above 10 m/s over the seconds in which the
/// robot moves (at least ten). Centimetres read as metres look like this. The log stays as it is.
/// @param name  of the file, for the messages
void warn_of_implausible_units(Log& log, const std::string& name);

}  // namespace cairn
