#include "cairn/maps/distance_field.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kFar = 1e20;

// Lower envelope of the parabolas (q, height[q]): out[p] = min over q of (p - q)^2 + height[q].
class ParabolaEnvelope {
 public:
  explicit ParabolaEnvelope(int longest)
      : apex_(longest), from_(longest + 1), height_(longest), out_(longest) {}

  std::vector<double>& heights() { return height_; }

  const std::vector<double>& transform(int n) {
    const int last = build(n);
    for (int p = 0, k = 0; p < n; ++p) {
      while (k < last && from_[k + 1] < p) ++k;
      const double offset = p - apex_[k];
      out_[p] = offset * offset + height_[apex_[k]];
    }
    return out_;
  }

 private:
  // Where the parabola of q becomes lower than that of p < q.
  double crossing(int p, int q) const {
    const double dp = p, dq = q;
    return ((height_[q] + dq * dq) - (height_[p] + dp * dp)) / (2.0 * (dq - dp));
  }

  int build(int n) {
    int k = 0;
    apex_[0] = 0;
    from_[0] = -std::numeric_limits<double>::infinity();
    for (int q = 1; q < n; ++q) {
      double start = crossing(apex_[k], q);
      while (k > 0 && start <= from_[k]) start = crossing(apex_[--k], q);
      apex_[++k] = q;
      from_[k] = start;
    }
    return k;
  }

  std::vector<int> apex_;
  std::vector<double> from_;
  std::vector<double> height_;
  std::vector<double> out_;
};

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, double max_distance_m)
    : geometry_(grid.geometry()), max_distance_m_(max_distance_m) {
  if (!(max_distance_m > 0.0)) {
    throw ConfigurationError("max_distance_m", "is not positive", "2 m is a good value");
  }
  const int width = geometry_.width;
  const int height = geometry_.height;
  std::vector<double> squared(geometry_.size());
  for (std::size_t i = 0; i < squared.size(); ++i) {
    squared[i] = grid.state(i) == CellState::kOccupied ? 0.0 : kFar;
  }
  ParabolaEnvelope envelope(std::max(width, height));
  for (int column = 0; column < width; ++column) {
    for (int row = 0; row < height; ++row) envelope.heights()[row] = squared[geometry_.index(column, row)];
    const std::vector<double>& out = envelope.transform(height);
    for (int row = 0; row < height; ++row) squared[geometry_.index(column, row)] = out[row];
  }
  distances_m_.resize(squared.size());
  for (int row = 0; row < height; ++row) {
    const std::size_t start = geometry_.index(0, row);
    std::copy_n(squared.begin() + static_cast<std::ptrdiff_t>(start), width, envelope.heights().begin());
    const std::vector<double>& out = envelope.transform(width);
    for (int column = 0; column < width; ++column) {
      const double metres = std::sqrt(out[column]) * geometry_.resolution_m;
      distances_m_[start + static_cast<std::size_t>(column)] =
          static_cast<float>(std::min(metres, max_distance_m));
    }
  }
}

}  // namespace cairn
