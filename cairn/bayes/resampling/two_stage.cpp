#include "cairn/bayes/resampling/two_stage.hpp"

#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

namespace {

// Wider than that, particles at one place have several headings.
constexpr double kOneHeading_rad = 0.5;

// Standard deviation on the circle.
double heading_spread(std::span<const Pose2> poses, std::span<const double> weights) {
  double cosine = 0.0, sine = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    cosine += weights[i] * std::cos(poses[i].theta), sine += weights[i] * std::sin(poses[i].theta);
    sum += weights[i];
  }
  return std::sqrt(-2.0 * std::log(std::clamp(std::hypot(cosine, sine) / sum, 1e-300, 1.0)));
}

}  // namespace

// A belief that the moves hold for one compact group is one cluster, stragglers included, if it was one
// before or has one heading: what lies beside it is no hypothesis, and no share of the particles is kept for
// it (decision 73). The first portion of a scan often leaves several headings of a robot that has turned far.
bool ClusterWatch::fit(const ParticleSet<Pose2>& particles) {
  const bool compact = moves_->fit(particles);
  const std::span<const double> weights = weights_of(particles);
  table_->particles = particles.size();
  const bool was_one = table_->clusters == 1;
  if (compact && (was_one || heading_spread(particles.states, weights) < kOneHeading_rad)) {
    table_->label.clear();
    table_->clusters = 1;
    return true;
  }
  PoseHypotheses hypotheses = find_hypotheses(particles.states, weights, options_);
  table_->label = std::move(hypotheses.label);
  table_->clusters = hypotheses.found.size();
  return compact && table_->clusters == 1;
}

// A filter keeps them beside their logarithms.
std::span<const double> ClusterWatch::weights_of(const ParticleSet<Pose2>& particles) {
  if (particles.weights.size() == particles.size()) return particles.weights;
  weights_.resize(particles.size());
  exp_all(particles.log_weights, 0.0, weights_);
  return weights_;
}

void ClusterWatch::save(PartMemory& memory) const {
  memory.put(static_cast<double>(table_->clusters));
  memory.put(static_cast<double>(table_->particles));
  memory.put(static_cast<double>(table_->label.size()));
  for (const int label : table_->label) memory.put(label);
  moves_->save(memory);
}

void ClusterWatch::load(PartMemory::Reader& memory) {
  table_->clusters = static_cast<std::size_t>(memory.take());
  table_->particles = static_cast<std::size_t>(memory.take());
  table_->label.resize(static_cast<std::size_t>(memory.take()));
  for (int& label : table_->label) label = static_cast<int>(memory.take());
  moves_->load(memory);
}

// The members of a cluster and their weights, summed up to 1. Returns the cluster's weight.
double TwoStage::select(std::span<const double> cumulative, int cluster) {
  members_.clear();
  member_cumulative_.clear();
  double sum = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i) {
    if (table_->label[i] != cluster) continue;
    const double weight = cumulative[i] - (i == 0 ? 0.0 : cumulative[i - 1]);
    members_.push_back(static_cast<std::uint32_t>(i));
    member_cumulative_.push_back(sum += weight);
  }
  for (double& c : member_cumulative_) c /= sum;
  member_cumulative_.back() = 1.0;
  return sum;
}

void TwoStage::draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
                    std::vector<std::uint32_t>& ancestors) {
  const std::size_t clusters = table_->clusters;
  log_cluster_weights_.assign(clusters, 0.0);
  if (table_->label.empty()) {  // KLD-sampling draws a few at a time: no look at all particles for each
    draw_systematic(cumulative, count, numbers.single(), ancestors);
    return;
  }
  CAIRN_ASSERT(table_->label.size() == cumulative.size());
  for (std::size_t cluster = 0; cluster < clusters; ++cluster) {
    const std::size_t share = count * (cluster + 1) / clusters - count * cluster / clusters;
    log_cluster_weights_[cluster] = std::log(select(cumulative, static_cast<int>(cluster)));
    drawn_.clear();
    draw_systematic(member_cumulative_, share, numbers.single(), drawn_);
    for (const std::uint32_t member : drawn_) ancestors.push_back(members_[member]);
    cluster_of_drawn_.insert(cluster_of_drawn_.end(), share, cluster);
  }
}

// A cluster's weight C_j^memory, shared by its particles.
bool TwoStage::weigh_drawn(std::span<double> log_weights) {
  const std::vector<std::size_t> drawn = std::exchange(cluster_of_drawn_, {});
  if (memory_ == 0.0 || log_cluster_weights_.size() < 2) return false;
  std::vector<double> particles(log_cluster_weights_.size(), 0.0);
  for (const std::size_t cluster : drawn) particles[cluster] += 1.0;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    log_weights[i] += memory_ * log_cluster_weights_[drawn[i]] - std::log(particles[drawn[i]]);
  return true;
}

}  // namespace cairn
