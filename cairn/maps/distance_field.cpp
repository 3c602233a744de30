#include "cairn/maps/distance_field.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_transform.hpp"

#include <limits>

namespace cairn {
namespace {

// The smallest squared number of cells that is at least as far as the largest distance, or as anything can be
// on this grid.
std::uint32_t far_of(const GridGeometry& g, double max_distance_m) {
  const double width = g.width, height = g.height;
  const double cells = max_distance_m / g.resolution_m;
  double far = std::min(std::ceil(cells * cells), width * width + height * height);
  far = std::min<double>(far, std::numeric_limits<std::uint32_t>::max());
  // Rounding must not put a distance of exactly the largest one below it.
  while (far > 1.0 && std::sqrt(far - 1.0) * g.resolution_m >= max_distance_m) far -= 1.0;
  return static_cast<std::uint32_t>(far);
}

LargeVector<std::uint32_t> as_integers(const std::vector<double>& squared, std::uint32_t far) {
  LargeVector<std::uint32_t> result(squared.size());
  std::transform(squared.begin(), squared.end(), result.begin(),
                 [&](double d) { return static_cast<std::uint32_t>(std::min<double>(d, far)); });
  return result;
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, double max_distance_m, const Executor& executor)
    : geometry_(grid.geometry()), max_distance_m_(max_distance_m) {
  if (!(max_distance_m > 0.0)) {
    throw ConfigurationError("max_distance_m", "is not positive", "2 m is a good value");
  }
  far_ = far_of(geometry_, max_distance_m);
  if (far_ <= kMostTruncationCells * kMostTruncationCells) {
    narrow_ = truncated_squared_distances(grid, static_cast<std::uint16_t>(far_), executor);
  } else {
    wide_ = as_integers(squared_distances(grid), far_);
  }
}

std::vector<float> DistanceField::all_distances_m() const {
  std::vector<float> metres(geometry_.size());
  for (std::size_t i = 0; i < metres.size(); ++i) metres[i] = distance_m(i);
  return metres;
}

}  // namespace cairn
