#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"

#include <cstddef>
#include <cstdint>

namespace cairn {

/// Error bound of KLD-sampling (Fox, "Adapting the sample size in particle filters through KLD-sampling",
/// IJRR 2003; Sehestedt & Schneider, eq. 2).
struct KldOptions {
  double epsilon = 0.1;          ///< largest Kullback-Leibler distance to the true posterior
  double confidence = 0.99;      ///< probability that the distance stays below epsilon, the 1 - delta
  double bin_size_m = 0.5;       ///< cells in which the support of the belief is counted
  double bin_size_rad = 0.1745;  ///< rounded so that a whole number of bins fills the circle

  void visit(OptionVisitor& visitor);
};

/// Number of samples after which the distance between the sample-based estimate and the posterior is below
/// epsilon, if the samples fall into `occupied_bins` bins. 1 for a single bin (the bound is 0 there).
std::size_t kld_bound(std::size_t occupied_bins, const KldOptions& options);

/// The same again and again for the same options.
class KldBound {
 public:
  explicit KldBound(const KldOptions& options);
  std::size_t operator()(std::size_t occupied_bins) const;

 private:
  double epsilon_, quantile_;
};

/// Cell of a pose in (x, y, heading), a key that is unique within +-2^20 cells and the same for headings that
/// differ by full turns.
class PoseBins {
 public:
  explicit PoseBins(const KldOptions& options);
  std::uint64_t key(const Pose2& pose) const;
  /// Bins of heading that fill the circle.
  std::int64_t heading_bins() const { return heading_bins_; }

 private:
  double cells_per_m_;
  double cells_per_rad_;
  std::int64_t heading_bins_;
};

}  // namespace cairn
