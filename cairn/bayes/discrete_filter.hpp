#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace cairn {

/// Discrete Bayes filter over finitely many states (Thrun et al., Probabilistic Robotics, table 4.1): doors,
/// rooms, the cells of a grid. It takes the same measurements as a particle filter over the same states, and
/// has no error but rounding: the oracle of the others where the states are few.
///
///     Bel-(x_i) = sum_j p(x_i | u, x_j) Bel(x_j)            predict
///     Bel(x_i)  = eta p(z | x_i) Bel-(x_i)                  correct
template <class State>
class DiscreteFilter {
 public:
  /// @param prior one number >= 0 per state, not all zero; need not sum to 1
  DiscreteFilter(std::vector<State> states, std::vector<double> prior)
      : states_(std::move(states)), belief_(std::move(prior)), log_likelihoods_(states_.size()) {
    CAIRN_ASSERT(!states_.empty() && states_.size() == belief_.size());
    CAIRN_ASSERT(std::all_of(belief_.begin(), belief_.end(), [](double p) { return p >= 0.0; }));
    normalize();
  }

  /// All states alike.
  explicit DiscreteFilter(std::vector<State> states)
      : DiscreteFilter(states, std::vector<double>(states.size(), 1.0)) {}

  /// @param transition p(to | u, from) in row `to` and column `from`: every column sums to 1
  void predict(const Eigen::MatrixXd& transition) { apply(transition); }
  /// Likewise, for many states of which each leads to few.
  void predict(const Eigen::SparseMatrix<double>& transition) { apply(transition); }

  /// Weighs the states by a measurement. Where the likelihoods of all states of the belief are beyond what a
  /// number can hold, their ratios still count.
  void correct(const BoundUpdate<State>& z) {
    z.log_likelihood(states_, log_likelihoods_);
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (belief_[i] > 0.0) largest = std::max(largest, log_likelihoods_[i]);
    }
    CAIRN_ASSERT(std::isfinite(largest));
    for (std::size_t i = 0; i < states_.size(); ++i)
      belief_[i] *= belief_[i] > 0.0 ? std::exp(log_likelihoods_[i] - largest) : 0.0;
    normalize();
  }

  std::span<const State> states() const { return states_; }
  /// Probability per state; they sum to 1.
  std::span<const double> belief() const { return belief_; }

 private:
  template <class Matrix>
  void apply(const Matrix& transition) {
    const auto n = static_cast<Eigen::Index>(states_.size());
    CAIRN_ASSERT(transition.rows() == n && transition.cols() == n);
    const Eigen::VectorXd moved = transition * Eigen::Map<const Eigen::VectorXd>(belief_.data(), n);
    CAIRN_ASSERT(std::abs(moved.sum() - 1.0) < 1e-6);  // no transition matrix otherwise
    Eigen::Map<Eigen::VectorXd>(belief_.data(), n) = moved;
    normalize();
  }

  void normalize() {
    const double sum = std::accumulate(belief_.begin(), belief_.end(), 0.0);
    CAIRN_ASSERT(sum > 0.0);
    for (double& p : belief_) p /= sum;
  }

  std::vector<State> states_;
  std::vector<double> belief_;
  std::vector<double> log_likelihoods_;
};

}  // namespace cairn
