#pragma once

#include "cairn/core/pose2.hpp"

#include <span>

namespace cairn {

// The sums behind weighted_moments, on all lanes of the processor. Eight partial sums in a fixed order: every
// path of simd.hpp gives the same bits.

/// Sums of the weights and of weight times x, y, cosine and sine of the heading.
struct FirstSums {
  double weight, x, y, cosine, sine;
  double largest_heading;  ///< the sums are right if this is below 1e6: headings are as they come
};
/// @pre equal sizes
FirstSums first_sums(std::span<const Pose2> poses, std::span<const double> weights);

/// Sums of weight times the products of the deviations from `mean`; those of the heading are shortest turns.
struct SecondSums {
  double xx, xy, xt, yy, yt, tt;
};
/// @pre equal sizes
SecondSums second_sums(const Pose2& mean, std::span<const Pose2> poses, std::span<const double> weights);

}  // namespace cairn
