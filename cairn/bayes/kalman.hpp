#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace cairn {

/// Kalman filter over N states, N fixed or Eigen::Dynamic (Thrun et al., Probabilistic Robotics, table 3.1):
///
///     x' = F x + u + w,  w ~ N(0, Q)          predict
///     z  = H x + v,      v ~ N(0, R)          correct
///
/// The covariance is updated in Joseph's form, which keeps it symmetric and positive for any gain. The models
/// may differ from step to step, so that a linearised model makes it an extended Kalman filter: give it the
/// predicted mean (set_mean) and the residual z - h(x) (correct_residual).
template <int N>
class KalmanFilter {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  KalmanFilter(const Vector& mean, const Matrix& covariance) : mean_(mean), covariance_(covariance) {}

  const Vector& mean() const { return mean_; }
  const Matrix& covariance() const { return covariance_; }

  void predict(const Matrix& F, const Vector& u, const Matrix& Q) {
    mean_ = (F * mean_ + u).eval();
    covariance_ = (F * covariance_ * F.transpose() + Q).eval();
  }

  /// What a measurement was worth, before it was used.
  struct Innovation {
    double squared_distance;  ///< of the residual, by its covariance: chi-square with as many degrees of
                              ///< freedom as the measurement has numbers
    double log_likelihood;    ///< log p(z | all measurements before)
  };

  /// nullopt, and nothing changes, if H P H' + R is not positive definite or z is not finite.
  template <int M>
  std::optional<Innovation> correct(const Eigen::Matrix<double, M, 1>& z,
                                    const Eigen::Matrix<double, M, N>& H,
                                    const Eigen::Matrix<double, M, M>& R) {
    return correct_residual<M>((z - H * mean_).eval(), H, R);
  }

  /// Likewise with the residual z - h(x), for a sensor that is linear only near the mean: H = dh/dx there.
  template <int M>
  std::optional<Innovation> correct_residual(const Eigen::Matrix<double, M, 1>& residual,
                                             const Eigen::Matrix<double, M, N>& H,
                                             const Eigen::Matrix<double, M, M>& R) {
    const Eigen::Matrix<double, M, M> S = H * covariance_ * H.transpose() + R;
    const Eigen::LLT<Eigen::Matrix<double, M, M>> cholesky(S);
    if (cholesky.info() != Eigen::Success || !residual.allFinite() || !S.allFinite()) return std::nullopt;
    // K = P H' S^-1, as the transpose of S^-1 H P.
    const Eigen::Matrix<double, N, M> K = cholesky.solve(H * covariance_).transpose();
    const Matrix I_KH = Matrix::Identity(mean_.size(), mean_.size()) - K * H;
    mean_ = (mean_ + K * residual).eval();
    covariance_ = (I_KH * covariance_ * I_KH.transpose() + K * R * K.transpose()).eval();
    const double distance = residual.dot(cholesky.solve(residual));
    const double log_determinant = 2.0 * cholesky.matrixLLT().diagonal().array().log().sum();
    const double dimensions = static_cast<double>(residual.size());
    return Innovation{distance,
                      -0.5 * (distance + log_determinant + dimensions * std::log(2.0 * std::numbers::pi))};
  }

  void set_mean(const Vector& mean) { mean_ = mean; }

 private:
  Vector mean_;
  Matrix covariance_;
};

}  // namespace cairn
