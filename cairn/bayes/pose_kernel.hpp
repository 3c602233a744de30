#pragma once

#include "cairn/bayes/regularization.hpp"
#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"

#include <vector>

namespace cairn {

struct PoseKernelOptions {
  double width = 0.4;             ///< standard deviation of the moves, as a share of the particles' own
  double largest_spread_m = 1.0;  ///< particles spread wider than this in position are not one group

  double min_weight = 0.95;  ///< a compact group holds at least this share of the belief
  double wide_m = 0.1;       ///< standard deviation of the moves in position while there is no such group
  double wide_rad = 0.05;    ///< likewise of the heading

  void visit(OptionVisitor& visitor);
};

/// Gaussian moves in x, y and heading, independent of each other. A width of 0.4 widens the belief by a
/// factor sqrt(1 + 0.4^2) = 1.08 per move.
class PoseKernel final : public Regularization<Pose2> {
 public:
  explicit PoseKernel(const PoseKernelOptions& options) : options_(options) {}
  bool fit(const ParticleSet<Pose2>& particles) override;
  void move(std::span<Pose2> states, const RandomStream& random, std::uint16_t draw) const override;
  void save(PartMemory& memory) const override;
  void load(PartMemory::Reader& memory) override;

 private:
  bool fit_group(std::span<const Pose2> poses, std::span<const double> weights);
  bool fit_heaviest_cluster(std::span<const Pose2> poses, std::span<double> weights);

  PoseKernelOptions options_;
  Pose2 sigma_;
  std::vector<double> weights_;  ///< scratch
};

}  // namespace cairn
