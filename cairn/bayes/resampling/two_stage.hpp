#pragma once

#include "cairn/bayes/hypotheses.hpp"
#include "cairn/bayes/regularization.hpp"
#include "cairn/bayes/resampling/resampling.hpp"
#include "cairn/bayes/sample_size.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace cairn {

/// What the parts of a clustered filter know of each other: the hypotheses of the particles as they are now.
/// A filter's own parts share one; two filters share none.
struct ClusterTable {
  /// Per particle; -1: of no significant cluster. Empty: all are of the only one.
  std::vector<int> label;
  std::size_t clusters = 1;   ///< significant ones
  std::size_t particles = 0;  ///< of the generation
};

/// Determines the significant clusters each time the particles have been weighed (Sehestedt & Schneider,
/// ICINCO 2006, table 3, step 4); leaves the moves to another regularization. Several clusters are not
/// compact.
class ClusterWatch final : public Regularization<Pose2> {
 public:
  ClusterWatch(std::shared_ptr<ClusterTable> table, const HypothesisOptions& options,
               std::unique_ptr<Regularization<Pose2>> moves)
      : table_(std::move(table)), options_(options), moves_(std::move(moves)) {}

  bool fit(const ParticleSet<Pose2>& particles) override;
  void move(std::span<Pose2> states, const RandomStream& random, std::uint16_t draw) const override {
    moves_->move(states, random, draw);
  }
  void save(PartMemory& memory) const override;
  void load(PartMemory::Reader& memory) override;

 private:
  std::span<const double> weights_of(const ParticleSet<Pose2>& particles);

  std::shared_ptr<ClusterTable> table_;
  HypothesisOptions options_;
  std::unique_ptr<Regularization<Pose2>> moves_;
  std::vector<double> weights_;  ///< where the particles do not bring them
};

/// Two-stage cluster sampling (Sehestedt & Schneider, section 5.1): every significant cluster is drawn, with
/// an equal share of the particles, whatever its weight; within a cluster, the particles are drawn
/// systematically by their weights. Particles of no significant cluster are not drawn: what they held is
/// spread over the significant ones. With one cluster this is systematic resampling of its particles.
///
/// In the paper (eq. 5 to 7) the weights are w = eta(x) p(z | x) with eta(x) = 1 / C_j, C_j the sum of the
/// weights in the cluster of x: after each measurement all clusters count alike, and only a measurement that
/// alone makes a cluster insignificant tells them apart. That is `memory` 0. With 1, a cluster keeps its
/// weight C_j, exactly as Bayes has it if the measurements are independent. Between the two it keeps
/// C_j^memory: a furniture that the map does not know speaks against the true place in every scan that sees
/// it, and must not be counted each time; what lies 1 / (1 - memory) measurements back is forgotten.
class TwoStage final : public Resampling {
 public:
  explicit TwoStage(std::shared_ptr<const ClusterTable> table, double memory = 0.0)
      : table_(std::move(table)), memory_(memory) {}
  void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
            std::vector<std::uint32_t>& ancestors) override;
  bool weigh_drawn(std::span<double> log_weights) override;

 private:
  double select(std::span<const double> cumulative, int cluster);

  std::shared_ptr<const ClusterTable> table_;
  double memory_;
  std::vector<std::uint32_t> members_;
  std::vector<double> member_cumulative_;
  std::vector<std::uint32_t> drawn_;
  std::vector<std::size_t> cluster_of_drawn_;  ///< since weigh_drawn()
  std::vector<double> log_cluster_weights_;
};

/// The number of particles of clustered KLD-SRL (Sehestedt & Schneider, table 4, steps 2 to 4): as another
/// rule says, but while there are several clusters it never shrinks.
class NeverFewerWhileClustered final : public SampleSize<Pose2> {
 public:
  NeverFewerWhileClustered(std::shared_ptr<const ClusterTable> table, std::unique_ptr<SampleSize<Pose2>> rule)
      : table_(std::move(table)), rule_(std::move(rule)) {}
  std::size_t begin() override { return std::max(rule_->begin(), least()); }
  std::size_t wanted(std::span<const Pose2> newly_drawn) override {
    return std::max(rule_->wanted(newly_drawn), least());
  }
  std::size_t most() const override { return rule_->most(); }
  void save(PartMemory& memory) const override { rule_->save(memory); }
  void load(PartMemory::Reader& memory) override { rule_->load(memory); }

 private:
  std::size_t least() const { return table_->clusters > 1 ? std::min(table_->particles, rule_->most()) : 0; }
  std::shared_ptr<const ClusterTable> table_;
  std::unique_ptr<SampleSize<Pose2>> rule_;
};

}  // namespace cairn
