#include "cairn/models/search/local_posterior.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace cairn {
namespace {

BoundUpdate<Pose2> gaussian(const Pose2& mean, const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d information = covariance.inverse();
  return {{}, [mean, information](std::span<const Pose2> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i) {
              const Eigen::Vector3d d(states[i].x - mean.x, states[i].y - mean.y,
                                      normalize_angle(states[i].theta - mean.theta));
              out[i] = 5.0 - 0.5 * d.dot(information * d);
            }
          }};
}

Eigen::Matrix3d oblique() {
  Eigen::Matrix3d c;
  c << 0.0100, 0.0060, 0.0004,  //
      0.0060, 0.0050, 0.0002,   //
      0.0004, 0.0002, 0.0004;
  return c;
}

// A Gaussian likelihood has a known integral; 3 sigma hold 99 % of it in three dimensions and cut the moments
// by less than 6 %.
TEST(LocalPosterior, OfAGaussianIsTheGaussian) {
  const Pose2 mean{2.0, -1.0, 3.13};  // next to where headings wrap
  const LocalPosterior p = local_posterior(gaussian(mean, oblique()), {2.06, -0.95, -3.12}, {});
  EXPECT_NEAR(distance(p.mean, mean), 0.0, 0.01);
  EXPECT_NEAR(normalize_angle(p.mean.theta - mean.theta), 0.0, 0.002);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(oblique()(i, i) * oblique()(j, j));
      EXPECT_NEAR(p.covariance(i, j) / scale, oblique()(i, j) / scale, 0.08) << i << j;
    }
  }
  const double exact = 5.0 + 1.5 * std::log(kTwoPi) + 0.5 * std::log(oblique().determinant());
  EXPECT_NEAR(p.log_mass, exact, 0.05);
  EXPECT_NEAR(p.largest, 5.0, 0.05);
}

TEST(LocalPosterior, MassesCompareWideAndNarrowModes) {
  const Eigen::Matrix3d narrow = 0.25 * oblique();
  const double wide_mass = local_posterior(gaussian({}, oblique()), {}, {}).log_mass;
  const double narrow_mass = local_posterior(gaussian({}, narrow), {}, {}).log_mass;
  EXPECT_NEAR(wide_mass - narrow_mass, 1.5 * std::log(4.0), 0.05);
}

TEST(LocalPosterior, StaysWithinItsReach) {
  const LocalPosterior p = local_posterior(gaussian({}, 1e4 * Eigen::Matrix3d::Identity()), {}, {0.5, 0.17});
  EXPECT_LT(std::sqrt(p.covariance(0, 0)), 0.5);
  EXPECT_NEAR(p.log_mass, 5.0 + std::log(1.0 * 1.0 * 0.34), 0.5);  // the box, filled evenly
}

}  // namespace
}  // namespace cairn
