#include "cairn/eval/downsample.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <numeric>

namespace cairn {
namespace {

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

// Smallest and largest of values[begin, end), in the order of their places.
void append_extremes(std::span<const double> values, std::size_t begin, std::size_t end,
                     std::vector<std::size_t>& indices) {
  const auto stretch = values.subspan(begin, end - begin);
  const auto [low, high] = std::minmax_element(stretch.begin(), stretch.end());
  const std::size_t a = begin + static_cast<std::size_t>(low - stretch.begin());
  const std::size_t b = begin + static_cast<std::size_t>(high - stretch.begin());
  indices.push_back(std::min(a, b));
  if (a != b) indices.push_back(std::max(a, b));
}

}  // namespace

std::vector<std::size_t> select_extremes(std::span<const double> values, std::size_t max_points) {
  CAIRN_ASSERT(max_points >= 4);
  const std::size_t count = values.size();
  if (count <= max_points) return all_of(count);
  const std::size_t stretches = (max_points - 2) / 2;
  const std::size_t inner = count - 2;
  std::vector<std::size_t> indices = {0};
  for (std::size_t k = 0; k < stretches; ++k) {
    append_extremes(values, 1 + inner * k / stretches, 1 + inner * (k + 1) / stretches, indices);
  }
  indices.push_back(count - 1);
  return indices;
}

std::vector<std::size_t> select_evenly(std::size_t count, std::size_t max_points) {
  CAIRN_ASSERT(max_points >= 2);
  if (count <= max_points) return all_of(count);
  std::vector<std::size_t> indices(max_points);
  for (std::size_t k = 0; k < max_points; ++k) indices[k] = k * (count - 1) / (max_points - 1);
  return indices;
}

}  // namespace cairn
