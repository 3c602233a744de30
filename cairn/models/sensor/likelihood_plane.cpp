#include "cairn/models/sensor/likelihood_plane.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/models/sensor/likelihood_plane_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

// Distances occur in few different values: each is worked out once.
class CodeOfDistance {
 public:
  CodeOfDistance(const DistanceField& field, const std::function<double(double)>& log_likelihood, double best,
                 double step)
      : field_(field),
        log_likelihood_(log_likelihood),
        best_(best),
        per_step_(step > 0.0 ? 1.0 / step : 0.0) {
    constexpr std::uint32_t kLongestTable = 1 << 16;
    known_.resize(std::min(field.far() + 1, kLongestTable));
    for (std::uint32_t squared = 0; squared < known_.size(); ++squared) known_[squared] = work_out(squared);
  }

  std::uint32_t operator()(std::size_t cell) const {
    const std::uint32_t squared = std::min(field_.squared_cells(cell), field_.far());
    return squared < known_.size() ? known_[squared] : work_out(squared);
  }

 private:
  std::uint32_t work_out(std::uint32_t squared) const {
    const double metres = std::sqrt(static_cast<double>(squared)) * field_.geometry().resolution_m;
    const double distance = squared >= field_.far() ? field_.max_distance_m() : metres;
    return static_cast<std::uint32_t>(std::lround((best_ - log_likelihood_(distance)) * per_step_));
  }

  const DistanceField& field_;
  const std::function<double(double)>& log_likelihood_;
  double best_;
  double per_step_;
  std::vector<std::uint32_t> known_;
};

}  // namespace

LikelihoodPlane::LikelihoodPlane(const DistanceField& field, Codes codes,
                                 const std::function<double(double)>& log_likelihood)
    : T_grid_map_(inverse(field.geometry().T_map_grid)),
      cells_per_m_(1.0 / field.geometry().resolution_m),
      columns_(static_cast<std::uint32_t>(field.geometry().width) + 2),
      rows_(static_cast<std::uint32_t>(field.geometry().height) + 2),
      best_(log_likelihood(0.0)) {
  if (std::uint64_t{columns_} * rows_ > std::numeric_limits<std::uint32_t>::max() ||
      std::max(columns_, rows_) > kFarAway_cells) {
    throw InputError("occupancy grid", "has more than 2^32 cells or is longer than 2^20",
                     "use larger cells, or a part of the map");
  }
  const double largest_code = codes == Codes::k8Bit ? std::numeric_limits<std::uint8_t>::max()
                                                    : std::numeric_limits<std::uint16_t>::max();
  step_ = (best_ - log_likelihood(field.max_distance_m())) / largest_code;
  if (codes == Codes::k8Bit) {
    fill(field, log_likelihood, narrow_);
  } else {
    fill(field, log_likelihood, wide_);
  }
}

template <class Code>
void LikelihoodPlane::fill(const DistanceField& field, const std::function<double(double)>& log_likelihood,
                           LargeVector<Code>& codes) {
  const CodeOfDistance code_of(field, log_likelihood, best_, step_);
  const Code worst = step_ > 0.0 ? std::numeric_limits<Code>::max() : Code{0};
  codes.assign(std::size_t{columns_} * rows_, worst);
  std::size_t cell = 0;
  for (std::size_t row = 1; row + 1 < rows_; ++row) {
    for (std::size_t column = 1; column + 1 < columns_; ++column)
      codes[row * columns_ + column] = static_cast<Code>(code_of(cell++));
  }
}

BeamsInCells LikelihoodPlane::in_cells(std::span<const Point2> points) const {
  BeamsInCells beams{points.size(), {}, {}};
  beams.x.resize(points.size() + kBeamPadding);
  beams.y.resize(points.size() + kBeamPadding);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double x = points[k].x * cells_per_m_, y = points[k].y * cells_per_m_;
    const bool near = std::abs(x) < kFarAway_cells && std::abs(y) < kFarAway_cells;
    beams.x[k] = static_cast<float>(near ? x : 4.0 * kFarAway_cells);
    beams.y[k] = static_cast<float>(near ? y : 4.0 * kFarAway_cells);
  }
  return beams;
}

void LikelihoodPlane::sum_codes(const BeamsInCells& beams, std::span<const Pose2> states,
                                std::span<std::uint32_t> sums) const {
  CAIRN_ASSERT(sums.size() == states.size());
  const bool narrow = codes() == Codes::k8Bit;
  const LikelihoodPlaneView plane{narrow ? narrow_.data() : nullptr, wide_.data(), columns_, rows_};
  const BeamsView view{beams.x.data(), beams.y.data(), beams.count};
  const PlaneFrame frame{std::cos(T_grid_map_.theta) * cells_per_m_,
                         std::sin(T_grid_map_.theta) * cells_per_m_, T_grid_map_.x * cells_per_m_ + 1.0,
                         T_grid_map_.y * cells_per_m_ + 1.0, T_grid_map_.theta};
  PoseBlock block;
  for (std::size_t begin = 0; begin < states.size(); begin += PoseBlock::kCapacity) {
    const std::size_t count = std::min(PoseBlock::kCapacity, states.size() - begin);
    put_in_cells(frame, states.subspan(begin, count), block);
    cairn::sum_codes(plane, view, block);
    std::copy_n(block.sums.begin(), count, sums.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

}  // namespace cairn
