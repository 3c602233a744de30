#include "cairn/bayes/occupied_bins.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kHalfSide = 16.0;  // of OccupiedBins::kSide cells

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
  std::size_t fresh = 0;
  for (const Pose2& pose : poses) {
    const double x = pose.x * cells_per_m_ - first_x_, y = pose.y * cells_per_m_ - first_y_;
    const double theta = pose.theta >= -kPi && pose.theta < kPi ? pose.theta : normalize_angle(pose.theta);
    const bool near = x >= 0.0 && x < kSide && y >= 0.0 && y < kSide;
    if (!near || std::isnan(theta)) {
      far_.insert(bins_.key(pose));
      continue;
    }
    // A turn more, so that cutting off is rounding down.
    const auto turn = static_cast<std::int32_t>(theta * cells_per_rad_ + headings_);
    const std::int32_t heading = turn >= headings_ ? turn - headings_ : turn;
    const std::int32_t row = static_cast<std::int32_t>(y) * kSide + static_cast<std::int32_t>(x);
    std::uint8_t& mark = marks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(headings_) +
                                static_cast<std::size_t>(heading)];
    fresh += mark != round_ ? 1 : 0;
    mark = round_;
  }
  near_ += fresh;
}

}  // namespace cairn
