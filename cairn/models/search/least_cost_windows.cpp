#include "cairn/models/search/least_cost_windows.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kSteps = 255.0;

double negative_log(const LikelihoodFieldOptions& o, double distance_m) {
  const double d = distance_m / o.sigma_hit_m;
  return -std::log(o.z_hit * std::exp(-d * d / 2.0) + o.z_rand);
}

// 1, 2, 3, 4, 6, 8, 12, 16, ...: at most half as wide again as needed.
int next_size(int size) {
  if (size < 2) return size + 1;
  const bool power_of_two = (size & (size - 1)) == 0;
  return power_of_two ? size + size / 2 : size / 3 * 4;
}

}  // namespace

LeastCostWindows::Plane::Plane(int columns, int rows, int size)
    : columns_(columns),
      rows_(rows),
      size_(size),
      stride_(static_cast<std::size_t>(columns + size) + 1),
      steps_(stride_ * (static_cast<std::size_t>(rows + size) + 1), static_cast<std::uint8_t>(kSteps)) {}

LeastCostWindows::LeastCostWindows(const DistanceField& field, const LikelihoodFieldOptions& model,
                                   const CellBox& box, int largest_window)
    : box_(box),
      least_(negative_log(model, 0.0)),
      far_(static_cast<float>(negative_log(model, field.max_distance_m()) - least_)) {
  // A model that no distance changes (z_hit 0) costs nothing anywhere.
  cost_per_step_ = far_ > 0.0f ? static_cast<double>(far_) / kSteps : 1.0;
  costs_.reserve(static_cast<std::size_t>(box.columns) * static_cast<std::size_t>(box.rows));
  for (int row = 0; row < box.rows; ++row) {
    for (int column = 0; column < box.columns; ++column) {
      const std::size_t cell = field.geometry().index(box.first_column + column, box.first_row + row);
      costs_.push_back(static_cast<float>(negative_log(model, field.distance_m(cell)) - least_));
    }
  }
  planes_.push_back(quantised());
  std::size_t half = 0;  // the largest plane of a power of two: any window up to twice as wide is four of its
  for (int size = next_size(1); size <= largest_window; size = next_size(size)) {
    planes_.push_back(pooled(planes_[half], size));
    if ((size & (size - 1)) == 0) half = planes_.size() - 1;
  }
}

LeastCostWindows::Plane LeastCostWindows::quantised() const {
  Plane plane(box_.columns, box_.rows, 1);
  for (int row = 0; row < box_.rows; ++row) {
    for (int column = 0; column < box_.columns; ++column) {
      const double steps = std::floor(cost(column, row) / cost_per_step_);
      plane.cell(column, row) = static_cast<std::uint8_t>(std::clamp(steps, 0.0, kSteps));
    }
  }
  return plane;
}

// The least of four windows that overlap: their corners are those of the larger one.
LeastCostWindows::Plane LeastCostWindows::pooled(const Plane& smaller, int size) const {
  Plane plane(box_.columns, box_.rows, size);
  const int shift = size - smaller.size();
  for (int row = -size; row <= box_.rows; ++row) {
    for (int column = -size; column <= box_.columns; ++column) {
      const std::uint8_t lower = std::min(smaller.at(column, row), smaller.at(column + shift, row));
      const std::uint8_t upper =
          std::min(smaller.at(column, row + shift), smaller.at(column + shift, row + shift));
      plane.cell(column, row) = std::min(lower, upper);
    }
  }
  return plane;
}

std::size_t LeastCostWindows::plane_for(int size) const {
  const auto large_enough = [size](const Plane& plane) { return plane.size() >= size; };
  return static_cast<std::size_t>(std::find_if(planes_.begin(), planes_.end(), large_enough) -
                                  planes_.begin());
}

double LeastCostWindows::cost(int column, int row) const {
  if (column < 0 || column >= box_.columns || row < 0 || row >= box_.rows) return far_;
  return costs_[static_cast<std::size_t>(row) * static_cast<std::size_t>(box_.columns) +
                static_cast<std::size_t>(column)];
}

}  // namespace cairn
