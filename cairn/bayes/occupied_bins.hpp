#pragma once

#include "cairn/bayes/key_set.hpp"
#include "cairn/bayes/kld.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/core/pose_cells.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// Counts the bins (PoseBins) that a set of poses occupies, again and again.
///
/// A belief is compact most of the time: the bins around the first pose have a mark each, which costs a few
/// operations per pose; those farther away are kept in a KeySet.
class OccupiedBins {
 public:
  explicit OccupiedBins(const KldOptions& options);

  void clear();
  void insert(std::span<const Pose2> poses);
  std::size_t size() const { return near_ + far_.size(); }

 private:
  static constexpr int kSide = 32;  ///< marked cells along x and y

  void put_marks_around(const Pose2& pose);
  void insert_elsewhere(const PoseCells& near, const Pose2& pose);

  PoseBins bins_;
  double cells_per_m_;
  double cells_per_rad_;
  std::int32_t headings_;
  double first_x_ = 0.0;  ///< of the marked cells, in cells: whole numbers
  double first_y_ = 0.0;
  bool placed_ = false;
  std::uint8_t round_ = 0;           ///< the marks of earlier rounds count as none
  std::vector<std::uint8_t> marks_;  ///< heading by heading, then along x, then along y
  std::size_t near_ = 0;
  KeySet far_;
};

}  // namespace cairn
