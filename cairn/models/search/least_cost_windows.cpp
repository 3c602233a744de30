#include "cairn/models/search/least_cost_windows.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kSteps = 255.0;
constexpr auto kMost = static_cast<std::uint8_t>(kSteps);
// Windows of a tier, in quarters of its stride: at most a quarter wider than needed up to twice the stride.
constexpr std::array kQuarters = {4, 5, 6, 7, 8, 10, 12, 16};
constexpr int kMargin = LeastCostWindows::kLargest + 1;

std::size_t whole(int number) { return static_cast<std::size_t>(number); }

double negative_log(const LikelihoodFieldOptions& o, double distance_m) {
  const double d = distance_m / o.sigma_hit_m;
  return -std::log(o.z_hit * std::exp(-d * d / 2.0) + o.z_rand);
}

std::vector<int> sizes_of(int tier) {
  if (tier == 0) return {1};
  std::vector<int> sizes;
  for (const int quarters : kQuarters) {
    const int size = LeastCostWindows::stride(tier) * quarters / 4;
    if (size <= LeastCostWindows::kLargest) sizes.push_back(size);
  }
  return sizes;
}

}  // namespace

LeastCostWindows::LeastCostWindows(const DistanceField& field, const LikelihoodFieldOptions& model,
                                   const CellBox& box)
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
  Windows half = quantised();  // of a power of two: any window up to twice as wide is four of its
  for (int tier = 0; tier < kTiers; ++tier) {
    for (const int size : sizes_of(tier)) {
      while (2 * half.size <= size) half = pooled(half, 2 * half.size);
      tiers_[static_cast<std::size_t>(tier)].push_back(
          in_order(size == half.size ? half : pooled(half, size), tier));
    }
  }
}

std::size_t LeastCostWindows::place(int column, int row) const {
  return whole(row + kMargin) * whole(box_.columns + 2 * kMargin) + whole(column + kMargin);
}

LeastCostWindows::Windows LeastCostWindows::quantised() const {
  Windows windows{1, LargeVector<std::uint8_t>(place(box_.columns + kMargin, box_.rows + kMargin), kMost)};
  for (int row = 0; row < box_.rows; ++row) {
    for (int column = 0; column < box_.columns; ++column) {
      const double steps = std::floor(cost(column, row) / cost_per_step_);
      windows.steps[place(column, row)] = static_cast<std::uint8_t>(std::clamp(steps, 0.0, kSteps));
    }
  }
  return windows;
}

// The least of four windows that overlap: their corners are those of the larger one.
LeastCostWindows::Windows LeastCostWindows::pooled(const Windows& smaller, int size) const {
  Windows windows{size, LargeVector<std::uint8_t>(smaller.steps.size(), kMost)};
  const int shift = size - smaller.size;
  const auto count = whole(box_.columns + size);
  const auto right = static_cast<std::size_t>(shift);
  for (int row = -size; row < box_.rows; ++row) {
    const std::uint8_t* lower = &smaller.steps[place(-size, row)];
    const std::uint8_t* upper = &smaller.steps[place(-size, row + shift)];
    std::uint8_t* out = &windows.steps[place(-size, row)];
    for (std::size_t i = 0; i < count; ++i)
      out[i] = std::min(std::min(lower[i], lower[i + right]), std::min(upper[i], upper[i + right]));
  }
  return windows;
}

// Those that are a stride apart next to each other.
LeastCostWindows::Plane LeastCostWindows::in_order(const Windows& windows, int tier) const {
  Plane plane;
  plane.size_ = windows.size;
  plane.columns_ = box_.columns, plane.rows_ = box_.rows;
  plane.margin_ = windows.size + 3 * stride(tier);
  plane.shift_ = 2 * tier;
  const auto places_for = [&](int cells) {
    const int all = plane.margin_ + cells + 4 * stride(tier);
    return whole((all >> plane.shift_) + 1);
  };
  plane.row_step_ = 4 * places_for(box_.columns);
  plane.phase_size_ = plane.row_step_ * (places_for(box_.rows) / 4 + 2);
  plane.steps_.assign(plane.phase_size_ << (2 * plane.shift_), kMost);
  const std::size_t within = (std::size_t{1} << plane.shift_) - 1;
  const auto first = whole(plane.margin_ - windows.size);
  const auto count = whole(box_.columns + windows.size);
  for (int row = -windows.size; row < box_.rows; ++row) {
    const std::uint8_t* from = &windows.steps[place(-windows.size, row)];
    // Where the row begins, in the first phase of the columns.
    const auto r = whole(row + plane.margin_);
    const std::size_t place = r >> plane.shift_;
    std::uint8_t* to = plane.steps_.data() + ((r & within) << plane.shift_) * plane.phase_size_ +
                       place / 4 * plane.row_step_ + place % 4;
    for (std::size_t c = first; c < first + count; ++c)
      to[(c & within) * plane.phase_size_ + 4 * (c >> plane.shift_)] = *from++;
  }
  return plane;
}

const LeastCostWindows::Plane* LeastCostWindows::plane_for(int tier, int size) const {
  const std::vector<Plane>& all = planes(tier);
  const auto found =
      std::find_if(all.begin(), all.end(), [size](const Plane& plane) { return plane.size() >= size; });
  return found == all.end() ? nullptr : &*found;
}

double LeastCostWindows::cost(int column, int row) const {
  if (column < 0 || column >= box_.columns || row < 0 || row >= box_.rows) return far_;
  return costs_[static_cast<std::size_t>(row) * static_cast<std::size_t>(box_.columns) +
                static_cast<std::size_t>(column)];
}

}  // namespace cairn
