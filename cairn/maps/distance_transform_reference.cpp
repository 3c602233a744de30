#include "cairn/maps/distance_transform.hpp"

#include <algorithm>
#include <limits>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar = 1e20;  // infinity minus infinity would not be a number

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
    from_[0] = -kInfinity;
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

std::vector<double> squared_distances(const OccupancyGrid& grid) {
  const GridGeometry& g = grid.geometry();
  std::vector<double> squared(g.size());
  for (std::size_t i = 0; i < squared.size(); ++i) {
    squared[i] = grid.state(i) == CellState::kOccupied ? 0.0 : kFar;
  }
  ParabolaEnvelope envelope(std::max(g.width, g.height));
  for (int column = 0; column < g.width; ++column) {
    for (int row = 0; row < g.height; ++row) envelope.heights()[row] = squared[g.index(column, row)];
    const std::vector<double>& out = envelope.transform(g.height);
    for (int row = 0; row < g.height; ++row) squared[g.index(column, row)] = out[row];
  }
  for (int row = 0; row < g.height; ++row) {
    const auto start = squared.begin() + static_cast<std::ptrdiff_t>(g.index(0, row));
    std::copy_n(start, g.width, envelope.heights().begin());
    const std::vector<double>& out = envelope.transform(g.width);
    std::transform(out.begin(), out.begin() + g.width, start,
                   [](double d) { return d < kFar / 2.0 ? d : kInfinity; });
  }
  return squared;
}

}  // namespace cairn
