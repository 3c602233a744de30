#include "cairn/bayes/kalman.hpp"

#include "cairn/core/rng.hpp"

#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using Vector1 = Eigen::Matrix<double, 1, 1>;

TEST(KalmanFilter, ScalarByHand) {
  KalmanFilter<1> filter(Vector1(1.0), Vector1(4.0));
  filter.predict(Vector1(1.0), Vector1(0.5), Vector1(1.0));
  EXPECT_DOUBLE_EQ(filter.mean()[0], 1.5);
  EXPECT_DOUBLE_EQ(filter.covariance()(0, 0), 5.0);
  const auto innovation = filter.correct<1>(Vector1(2.5), Vector1(1.0), Vector1(5.0));  // gain 1/2
  EXPECT_DOUBLE_EQ(filter.mean()[0], 2.0);
  EXPECT_DOUBLE_EQ(filter.covariance()(0, 0), 2.5);
  ASSERT_TRUE(innovation);
  EXPECT_DOUBLE_EQ(innovation->squared_distance, 0.1);
  EXPECT_NEAR(innovation->log_likelihood, -0.5 * (0.1 + std::log(2.0 * std::numbers::pi * 10.0)), 1e-14);
}

Eigen::MatrixXd random_matrix(int rows, int columns, std::uint64_t step) {
  const RandomStream random(5, RandomPurpose::kTest, step);
  Eigen::MatrixXd m(rows, columns);
  for (int i = 0; i < rows * columns; ++i)
    m(i / columns, i % columns) = random.normal4(static_cast<std::uint32_t>(i))[0];
  return m;
}

// The posterior of a chain of linear-Gaussian steps is that of one large least-squares problem.
TEST(KalmanFilter, AgreesWithLeastSquaresOverTheWholeHistory) {
  constexpr int kSteps = 12;
  using Filter = KalmanFilter<Eigen::Dynamic>;
  Filter filter(Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2) * 9.0);
  Eigen::MatrixXd F(2, 2), Q(2, 2), H(1, 2), R(1, 1);
  F << 1.0, 0.1, -0.2, 0.9;
  Q << 0.04, 0.01, 0.01, 0.09;
  R << 0.25;
  const int unknowns = 2 * (kSteps + 1);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(unknowns);
  information.topLeftCorner(2, 2) = Eigen::MatrixXd::Identity(2, 2) / 9.0;
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::VectorXd u = random_matrix(2, 1, 100 + k), z = random_matrix(1, 1, 200 + k);
    H = random_matrix(1, 2, 300 + k);
    filter.predict(F, u, Q);
    ASSERT_TRUE(filter.correct<Eigen::Dynamic>(z, H, R));
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(2, unknowns), look = Eigen::MatrixXd::Zero(1, unknowns);
    const Eigen::Index before = 2 * Eigen::Index{k}, after = before + 2;
    step.block(0, before, 2, 2) = -F;
    step.block(0, after, 2, 2) = Eigen::MatrixXd::Identity(2, 2);
    look.block(0, after, 1, 2) = H;
    information += step.transpose() * Q.inverse() * step + look.transpose() * R.inverse() * look;
    vector += step.transpose() * Q.inverse() * u + look.transpose() * R.inverse() * z;
  }
  const Eigen::MatrixXd covariance = information.inverse();
  EXPECT_LT((filter.mean() - (covariance * vector).tail(2)).norm(), 1e-10);
  EXPECT_LT((filter.covariance() - covariance.bottomRightCorner(2, 2)).norm(), 1e-10);
}

// Where the textbook's P - K H P loses symmetry and sign: a nearly exact sensor after a vague prior.
TEST(KalmanFilter, TheCovarianceStaysSymmetricAndPositive) {
  KalmanFilter<2> filter(Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity() * 1e12);
  for (int k = 0; k < 200; ++k) {
    const double angle = 1e-4 * k;
    const Eigen::Matrix<double, 1, 2> H(std::cos(angle), std::sin(angle));
    ASSERT_TRUE(filter.correct<1>(Vector1(1.0), H, Vector1(1e-10)));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(filter.covariance());
    EXPECT_GT(eigen.eigenvalues()[0], 0.0) << k;
    EXPECT_LT((filter.covariance() - filter.covariance().transpose()).norm(),
              1e-9 * filter.covariance().norm());
  }
}

TEST(KalmanFilter, WhatCannotBeUsedChangesNothing) {
  KalmanFilter<1> filter(Vector1(1.0), Vector1(4.0));
  EXPECT_FALSE(filter.correct<1>(Vector1(2.0), Vector1(1.0), Vector1(-5.0)));
  EXPECT_FALSE(filter.correct<1>(Vector1(std::nan("")), Vector1(1.0), Vector1(1.0)));
  EXPECT_FALSE(filter.correct<1>(Vector1(2.0), Vector1(std::nan("")), Vector1(1.0)));
  EXPECT_EQ(filter.mean()[0], 1.0);
  EXPECT_EQ(filter.covariance()(0, 0), 4.0);
}

}  // namespace
}  // namespace cairn
