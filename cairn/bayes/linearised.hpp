#pragma once

#include <Eigen/Core>

namespace cairn {

/// A measurement as a Gaussian one about a state x0 (Thrun et al., Probabilistic Robotics, table 3.3):
///   z = z_hat + H (x - x0) + v,  v ~ N(0, R)
/// What Kalman filters ask of a sensor model: `KalmanFilter::correct_residual<Eigen::Dynamic>(z - z_hat, H,
/// R)` at the predicted mean. N states, M numbers measured; M = 0: the measurement says nothing.
template <int N>
struct Linearised {
  Eigen::VectorXd z;                                        ///< as measured, M
  Eigen::VectorXd z_hat;                                    ///< as expected at x0, M
  Eigen::Matrix<double, Eigen::Dynamic, N> H;               ///< derivative of z_hat by the state at x0, M x N
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic> R;  ///< covariance of the noise, M x M

  Eigen::Index size() const { return z.size(); }
  Eigen::VectorXd residual() const { return z - z_hat; }
};

/// Capability of a sensor model: to say what a measurement means to a Kalman filter. Implementations are
/// immutable.
template <class State, int N, class Measurement>
class Linearises {
 public:
  virtual ~Linearises() = default;

  /// Everything in it is finite, and R is positive definite, whatever the measurement and the state.
  virtual Linearised<N> linearise(const Measurement& z, const State& about) const = 0;
};

}  // namespace cairn
