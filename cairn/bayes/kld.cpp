#include "cairn/bayes/kld.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

void KldOptions::visit(OptionVisitor& v) {
  v.number({"epsilon",
            "largest Kullback-Leibler distance between the samples and the belief",
            {"pf_err", "kld_err"}},
           epsilon, {1e-4, 1.0});
  v.number({"confidence", "probability that the distance stays below epsilon (1 - delta)"}, confidence,
           {0.5, 0.999999});
  v.number({"bin_size_m", "cell of the histogram that counts the support of the belief, metres"}, bin_size_m,
           {0.01, 10.0});
  v.number({"bin_size_rad", "cell of that histogram in heading, radians"}, bin_size_rad, {0.01, 3.2});
}

std::size_t kld_bound(std::size_t occupied_bins, const KldOptions& options) {
  return KldBound(options)(occupied_bins);
}

KldBound::KldBound(const KldOptions& options)
    : epsilon_(options.epsilon), quantile_(normal_quantile(options.confidence)) {}

std::size_t KldBound::operator()(std::size_t occupied_bins) const {
  if (occupied_bins <= 1) return 1;
  const double k = static_cast<double>(occupied_bins - 1);
  const double a = 2.0 / (9.0 * k);
  // Wilson-Hilferty approximation of the chi-square quantile with k degrees of freedom.
  const double cube_root = 1.0 - a + std::sqrt(a) * quantile_;
  return static_cast<std::size_t>(std::ceil(k / (2.0 * epsilon_) * cube_root * cube_root * cube_root));
}

PoseBins::PoseBins(const KldOptions& options)
    : cells_per_m_(1.0 / options.bin_size_m),
      heading_bins_(std::max<std::int64_t>(1, std::llround(kTwoPi / options.bin_size_rad))) {
  cells_per_rad_ = static_cast<double>(heading_bins_) / kTwoPi;
}

namespace {

// std::floor as an integer, without a call.
std::int64_t floor_of(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (static_cast<double>(truncated) > value ? 1 : 0);
}

}  // namespace

std::uint64_t PoseBins::key(const Pose2& pose) const {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  const auto cell = [](double value) { return static_cast<std::uint64_t>(floor_of(value)) & kMask; };
  std::int64_t turn = floor_of(pose.theta * cells_per_rad_);
  if (turn < 0) turn += heading_bins_;  // all that a heading in [-pi, pi) needs
  if (turn < 0 || turn >= heading_bins_) turn = ((turn % heading_bins_) + heading_bins_) % heading_bins_;
  return (cell(pose.x * cells_per_m_) << 42) | (cell(pose.y * cells_per_m_) << 21) |
         static_cast<std::uint64_t>(turn);
}

}  // namespace cairn
