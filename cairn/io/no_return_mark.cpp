#include "cairn/io/no_return_mark.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kBinM = 0.1;
constexpr double kNearestMarkM = 8.0;
constexpr double kMinShare = 0.001;
constexpr double kMinContrast = 20.0;
constexpr double kNeighbourhoodM = 5.0;

// Calls `visit` with every reading in (0, limit).
template <typename Visit>
void for_each_reading(std::span<const std::shared_ptr<LaserScan>> scans, double limit_m, Visit visit) {
  for (const auto& scan : scans) {
    for (const float range : scan->ranges_m) {
      if (range > 0.0F && range < limit_m) visit(static_cast<double>(range));
    }
  }
}

}  // namespace

std::optional<double> find_no_return_mark(std::span<const std::shared_ptr<LaserScan>> scans, double limit_m) {
  double largest = 0.0;
  double total = 0.0;
  for_each_reading(scans, limit_m, [&](double range) {
    largest = std::max(largest, range);
    total += 1.0;
  });
  if (largest < kNearestMarkM) return std::nullopt;
  double at_mark = 0.0;
  double below = 0.0;
  for_each_reading(scans, limit_m, [&](double range) {
    if (range > largest - kBinM) {
      at_mark += 1.0;
    } else if (range > largest - kBinM - kNeighbourhoodM) {
      below += 1.0;
    }
  });
  const double expected = below * kBinM / kNeighbourhoodM;
  const bool is_mark = at_mark >= kMinShare * total && at_mark >= kMinContrast * std::max(1.0, expected);
  return is_mark ? std::optional(largest) : std::nullopt;
}

}  // namespace cairn
