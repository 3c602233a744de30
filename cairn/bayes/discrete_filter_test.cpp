#include "cairn/bayes/discrete_filter.hpp"

#include "cairn/core/rng.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cairn {
namespace {

BoundUpdate<int> seen(std::vector<double> likelihoods) {
  return {Time{}, [likelihoods = std::move(likelihoods)](std::span<const int> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i)
              out[i] = std::log(likelihoods[static_cast<std::size_t>(states[i])]);
          }};
}

// --- The door of Burgard's tutorial: 0 is open, 1 is closed.

constexpr int kOpen = 0, kClosed = 1;

TEST(DiscreteFilter, TheDoorOfTheTutorial) {
  DiscreteFilter<int> door({kOpen, kClosed});
  EXPECT_DOUBLE_EQ(door.belief()[kOpen], 0.5);
  door.correct(seen({0.6, 0.3}));
  EXPECT_NEAR(door.belief()[kOpen], 2.0 / 3.0, 1e-15);
  door.correct(seen({0.5, 0.6}));
  EXPECT_NEAR(door.belief()[kOpen], 5.0 / 8.0, 1e-15);
  Eigen::MatrixXd close(2, 2);
  close << 0.1, 0.0,  // to open
      0.9, 1.0;       // to closed
  door.predict(close);
  EXPECT_NEAR(door.belief()[kClosed], 15.0 / 16.0, 1e-15);
  EXPECT_NEAR(door.belief()[kOpen], 1.0 / 16.0, 1e-15);
}

// --- Laws.

Eigen::MatrixXd random_transition(int n, std::uint64_t step) {
  const RandomStream random(1, RandomPurpose::kTest, step);
  Eigen::MatrixXd transition(n, n);
  for (int column = 0; column < n; ++column) {
    for (int row = 0; row < n; ++row) {
      const double u = random.uniform(static_cast<std::uint32_t>(column * n + row));
      transition(row, column) = u < 0.6 && row != column ? 0.0 : u;
    }
    transition.col(column) /= transition.col(column).sum();
  }
  return transition;
}

std::vector<int> numbered(int n) {
  std::vector<int> states(static_cast<std::size_t>(n));
  std::iota(states.begin(), states.end(), 0);
  return states;
}

TEST(DiscreteFilter, SparseAndDenseTransitionsAreTheSame) {
  DiscreteFilter<int> dense(numbered(30)), sparse(numbered(30));
  for (std::uint64_t step = 0; step < 10; ++step) {
    const Eigen::MatrixXd transition = random_transition(30, step);
    dense.predict(transition);
    sparse.predict(Eigen::SparseMatrix<double>(transition.sparseView()));
    for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(dense.belief()[i], sparse.belief()[i], 1e-14);
    EXPECT_NEAR(std::accumulate(dense.belief().begin(), dense.belief().end(), 0.0), 1.0, 1e-14);
  }
}

TEST(DiscreteFilter, TheOrderOfMeasurementsOfOneTimeDoesNotMatter) {
  const auto a = seen({0.2, 0.5, 0.9}), b = seen({0.7, 0.1, 0.3});
  DiscreteFilter<int> ab(numbered(3), {1.0, 2.0, 3.0}), ba(numbered(3), {0.1, 0.2, 0.3});
  ab.correct(a);
  ab.correct(b);
  ba.correct(b);
  ba.correct(a);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(ab.belief()[i], ba.belief()[i], 1e-15);
}

TEST(DiscreteFilter, LikelihoodsBeyondWhatExpHoldsStillCount) {
  DiscreteFilter<int> filter(numbered(3), {0.0, 0.5, 0.5});
  filter.correct({Time{}, [](std::span<const int>, std::span<double> out) {
                    out[0] = 1e6;  // not in the belief
                    out[1] = -1e6;
                    out[2] = -1e6 + std::log(3.0);
                  }});
  EXPECT_EQ(filter.belief()[0], 0.0);
  EXPECT_NEAR(filter.belief()[1], 0.25, 1e-9);
  EXPECT_NEAR(filter.belief()[2], 0.75, 1e-9);
}

TEST(DiscreteFilter, WhatIsNoBeliefAndNoTransitionIsRefused) {
  EXPECT_THROW(DiscreteFilter<int>({}), std::logic_error);
  EXPECT_THROW(DiscreteFilter<int>({0, 1}, {1.0}), std::logic_error);
  EXPECT_THROW(DiscreteFilter<int>({0, 1}, {0.0, 0.0}), std::logic_error);
  EXPECT_THROW(DiscreteFilter<int>({0, 1}, {1.0, std::nan("")}), std::logic_error);
  DiscreteFilter<int> filter(numbered(2));
  EXPECT_THROW(filter.predict(Eigen::MatrixXd::Identity(3, 3).eval()), std::logic_error);
  EXPECT_THROW(filter.predict((2.0 * Eigen::MatrixXd::Identity(2, 2)).eval()), std::logic_error);
}

}  // namespace
}  // namespace cairn
