#pragma once

#include "cairn/sensing/laser_scan.hpp"

#include <memory>
#include <optional>
#include <span>

namespace cairn {

/// The value by which a scanner that does not tell its maximum range marks "no return", found in its
/// readings: the largest value below `limit_m`, if it is at least 8 m, makes up at least 0.1 % of the
/// readings, and stands out: the 0.1 m below it hold 20 times as many readings as a decimetre of the 5 m
/// below them on average. (Old CARMEN logs: 50.00 in aces, 51.14 to 51.16 in edmonton.) nullopt if there is
/// no such value.
std::optional<double> find_no_return_mark(std::span<const std::shared_ptr<LaserScan>> scans, double limit_m);

}  // namespace cairn
