#include "cairn/bayes/occupied_bins.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr double kHalfSide = 16.0;  // of OccupiedBins::kSide cells
constexpr std::size_t kAtOnce = 256;

// The cell of a pose that seems to have none: perhaps its heading is just not in [-pi, pi).
std::int32_t unusual(const PoseCells& cells, const Pose2& pose) {
  if (std::abs(pose.theta) <= PoseCells::kLargestHeading) return PoseCells::kNone;
  return cells.cell_of({pose.x, pose.y, normalize_angle(pose.theta)});
}

}  // namespace

OccupiedBins::OccupiedBins(const KldOptions& options)
    : bins_(options),
      cells_per_m_(1.0 / options.bin_size_m),
      headings_(static_cast<std::int32_t>(bins_.heading_bins())) {
  cells_per_rad_ = headings_ / kTwoPi;
  marks_.resize(static_cast<std::size_t>(kSide) * kSide * static_cast<std::size_t>(headings_));
}

void OccupiedBins::clear() {
  if (++round_ == 0) {
    std::fill(marks_.begin(), marks_.end(), std::uint8_t{0});
    round_ = 1;
  }
  near_ = 0;
  far_.clear();
  placed_ = false;
}

void OccupiedBins::put_marks_around(const Pose2& pose) {
  first_x_ = std::floor(pose.x * cells_per_m_) - kHalfSide;
  first_y_ = std::floor(pose.y * cells_per_m_) - kHalfSide;
  placed_ = true;
}

void OccupiedBins::insert(std::span<const Pose2> poses) {
  if (!placed_ && !poses.empty()) put_marks_around(poses.front());
  const PoseCells near = {cells_per_m_, first_x_, first_y_, kSide, headings_};
  std::array<std::uint32_t, kAtOnce> elsewhere;
  for (; !poses.empty(); poses = poses.subspan(std::min(kAtOnce, poses.size()))) {
    const auto some = poses.first(std::min(kAtOnce, poses.size()));
    const CellsMarked done = mark_cells(near, some, round_, marks_, elsewhere);
    near_ += done.fresh;
    for (std::size_t k = 0; k < done.elsewhere; ++k) insert_elsewhere(near, some[elsewhere[k]]);
  }
}

void OccupiedBins::insert_elsewhere(const PoseCells& near, const Pose2& pose) {
  const std::int32_t cell = unusual(near, pose);
  if (cell == PoseCells::kNone) return far_.insert(bins_.key(pose));
  std::uint8_t& mark = marks_[static_cast<std::size_t>(cell)];
  near_ += mark != round_ ? 1 : 0;
  mark = round_;
}

}  // namespace cairn
