#include "cairn/core/variance_components.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Dense>

namespace cairn {
namespace {

using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, VarianceRow::kMost, 1>;
using Matrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, VarianceRow::kMost, VarianceRow::kMost>;

constexpr double kOutlierVariance = 25.0;
constexpr double kMostOutliers = 0.5;
constexpr double kLeastOutliers = 1e-6;
constexpr double kTolerance = 1e-6;
// A variance of nothing has no likelihood; this is far below what any sensor tells.
constexpr double kLeastVariance = 1e-14;

void check(std::span<const VarianceRow> rows, int components) {
  const bool counts = components >= 1 && components <= VarianceRow::kMost;
  if (!counts || rows.size() < static_cast<std::size_t>(components)) {
    throw InputError("variance components", "there are fewer residuals than unknowns", "use more data");
  }
  for (const VarianceRow& row : rows) {
    const bool fine = std::isfinite(row.residual) && std::isfinite(row.known) && row.known >= 0.0 &&
                      std::all_of(row.factor.begin(), row.factor.end(),
                                  [](double f) { return std::isfinite(f) && f >= 0.0; });
    if (!fine) throw InputError("variance components", "a residual is not finite", "check the data");
  }
}

class Fitter {
 public:
  Fitter(std::span<const VarianceRow> rows, int components) : rows_(rows), count_(components) {
    const double n = static_cast<double>(rows.size());
    scale_ = Vector::Zero(count_);
    double squares = 0.0;
    for (const VarianceRow& row : rows) {
      squares += row.residual * row.residual / n;
      for (int k = 0; k < count_; ++k) scale_[k] += row.factor[static_cast<std::size_t>(k)] / n;
    }
    // Each component begins with its share of the mean square; a factor that is zero everywhere stays out.
    component_ = Vector::Zero(count_);
    for (int k = 0; k < count_; ++k) {
      if (scale_[k] > 0.0) component_[k] = squares / count_ / scale_[k];
    }
  }

  void begin_at(const VarianceFit& start) {
    for (int k = 0; k < count_; ++k) component_[k] = start.component[static_cast<std::size_t>(k)];
    outliers_ = std::clamp(start.outlier_share, kLeastOutliers, kMostOutliers);
  }

  VarianceFit run(int max_iterations) {
    VarianceFit fit;
    double before = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < max_iterations && !fit.converged; ++i) {
      weigh();
      const double now = score() / static_cast<double>(rows_.size());
      fit.converged = std::abs(now - before) < kTolerance;
      before = now;
    }
    for (int k = 0; k < count_; ++k) fit.component[static_cast<std::size_t>(k)] = component_[k];
    fit.outlier_share = outliers_;
    return fit;
  }

 private:
  double variance(const VarianceRow& row, const Vector& component) const {
    double sum = row.known;
    for (int k = 0; k < count_; ++k) sum += row.factor[static_cast<std::size_t>(k)] * component[k];
    return std::max(kLeastVariance, sum);
  }

  // The densities of a residual as a good one and as an outlier, without the factor they share.
  std::array<double, 2> densities(double square, double variance) const {
    const double good = (1.0 - outliers_) * std::exp(-0.5 * square / variance);
    const double bad =
        outliers_ / std::sqrt(kOutlierVariance) * std::exp(-0.5 * square / (kOutlierVariance * variance));
    return {good, std::max(bad, std::numeric_limits<double>::min())};
  }

  double log_likelihood(const Vector& component) const {
    double sum = 0.0;
    for (const VarianceRow& row : rows_) {
      const double v = variance(row, component);
      const auto [good, bad] = densities(row.residual * row.residual, v);
      sum += std::log(good + bad) - 0.5 * std::log(v);
    }
    return sum;
  }

  // E-step: what each squared residual counts, and the share of outliers.
  void weigh() {
    weighted_square_.clear();
    double bad_sum = 0.0;
    for (const VarianceRow& row : rows_) {
      const double square = row.residual * row.residual;
      const auto [good, bad] = densities(square, variance(row, component_));
      const double is_bad = bad / (good + bad);
      bad_sum += is_bad;
      weighted_square_.push_back(square * (1.0 - is_bad + is_bad / kOutlierVariance));
    }
    outliers_ = std::clamp(bad_sum / static_cast<double>(rows_.size()), kLeastOutliers, kMostOutliers);
  }

  // M-step: one step of Fisher scoring, shortened until the likelihood does not fall.
  // Returns the log-likelihood.
  double score() {
    Matrix information = Matrix::Zero(count_, count_);
    Vector moment = Vector::Zero(count_);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const VarianceRow& row = rows_[i];
      const double v = variance(row, component_);
      const Vector x = Eigen::Map<const Eigen::Vector3d>(row.factor.data()).head(count_);
      information += x * x.transpose() / (v * v);
      moment += x * ((weighted_square_[i] - row.known) / (v * v));
    }
    const Vector target = non_negative(information, moment);
    const double now = log_likelihood(component_);
    for (double step = 1.0; step > 1e-3; step *= 0.5) {
      const Vector tried = component_ + step * (target - component_);
      const double then = log_likelihood(tried);
      if (then < now) continue;
      component_ = tried;
      return then;
    }
    return now;
  }

  // Minimises x'Ax/2 - b'x over x >= 0: of all sets of components that may differ from zero, the best one.
  Vector non_negative(const Matrix& a, const Vector& b) const {
    Vector best = Vector::Zero(count_);
    double lowest = 0.0;
    for (int set = 1; set < (1 << count_); ++set) {
      Matrix part = Matrix::Identity(count_, count_);
      Vector right = Vector::Zero(count_);
      for (int i = 0; i < count_; ++i) {
        if ((set >> i & 1) == 0) continue;
        right[i] = b[i];
        for (int j = 0; j < count_; ++j) {
          if ((set >> j & 1) != 0) part(i, j) = a(i, j);
        }
      }
      const Vector x = part.ldlt().solve(right);
      if (!x.allFinite() || x.minCoeff() < 0.0) continue;
      const double value = 0.5 * x.dot(a * x) - b.dot(x);
      if (value < lowest) {
        lowest = value;
        best = x;
      }
    }
    return best;
  }

  std::span<const VarianceRow> rows_;
  int count_;
  Vector scale_, component_;
  double outliers_ = 0.02;
  std::vector<double> weighted_square_;
};

}  // namespace

VarianceFit fit_variance_components(std::span<const VarianceRow> rows, int components,
                                    const VarianceFitOptions& options) {
  check(rows, components);
  Fitter fitter(rows, components);
  if (options.start) fitter.begin_at(*options.start);
  return fitter.run(options.max_iterations);
}

}  // namespace cairn
