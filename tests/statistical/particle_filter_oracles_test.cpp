// The particle filter against exact answers: the Kalman filter where all is linear and Gaussian, a fine grid
// where nothing is.
#include "cairn/bayes/discrete_filter.hpp"
#include "cairn/bayes/kalman.hpp"
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "examples/door_angle.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr int kSeeds = 40;
// Two-sided bound of Student's t with 39 degrees of freedom, false alarm 1e-7: ten comparisons in a test.
constexpr double kStudent = 6.55;

// The mean over the seeds lies at the exact value but for chance and for the oracle's own error, `exactness`.
// The standard error must be small, so that the test can fail.
void expect_unbiased(const std::vector<double>& values, double exact, double largest_standard_error,
                     double exactness = 0.0) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double spread = std::sqrt(squares / (n - 1.0)), standard_error = spread / std::sqrt(n);
  EXPECT_LT(standard_error, largest_standard_error);
  EXPECT_NEAR(mean, exact, kStudent * standard_error + exactness);
}

// --- A cart on a line: position and speed, of which the position is measured.

using State = Eigen::Vector2d;

const Eigen::Matrix2d kF = (Eigen::Matrix2d() << 1.0, 0.5, -0.1, 0.9).finished();
const Eigen::Vector2d kNoise(0.2, 0.3);  // standard deviations of the motion
const Eigen::Vector2d kPriorMean(1.0, -0.5), kPriorSigma(2.0, 1.0);
constexpr double kSensorSigma = 0.7;

struct Cart final : MotionModel<State, State> {
  void propagate(const State& u, std::span<State> states, const RandomStream& random) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(i));
      states[i] = (kF * states[i] + u + State(kNoise[0] * n[0], kNoise[1] * n[1])).eval();
    }
  }
};

struct Step {
  State u;
  double z;
};
const std::array kSteps = {Step{{0.1, 1.0}, 1.9},  Step{{0.0, 1.0}, 2.1}, Step{{0.2, 0.5}, 3.4},
                           Step{{0.0, -1.0}, 3.2}, Step{{0.0, 0.0}, 2.6}, Step{{0.1, 2.0}, 4.0}};

KalmanFilter<2> kalman() {
  KalmanFilter<2> filter(kPriorMean, kPriorSigma.cwiseAbs2().asDiagonal());
  using One = Eigen::Matrix<double, 1, 1>;
  for (const Step& step : kSteps) {
    filter.predict(kF, step.u, kNoise.cwiseAbs2().asDiagonal());
    EXPECT_TRUE(
        filter.correct<1>(One(step.z), Eigen::RowVector2d(1.0, 0.0), One(kSensorSigma * kSensorSigma)));
  }
  return filter;
}

struct Moments {
  State mean = State::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

Moments moments_of(const ParticleSet<State>& particles) {
  Moments m;
  for (std::size_t i = 0; i < particles.size(); ++i)
    m.mean += std::exp(particles.log_weights[i]) * particles.states[i];
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const State d = particles.states[i] - m.mean;
    m.covariance += std::exp(particles.log_weights[i]) * d * d.transpose();
  }
  return m;
}

BoundUpdate<State> position_seen(double z) {
  return {Time{}, [z](std::span<const State> states, std::span<double> out) {
            for (std::size_t i = 0; i < states.size(); ++i) {
              const double error = (states[i][0] - z) / kSensorSigma;
              out[i] = -0.5 * error * error - 100.0;  // constants do not matter
            }
          }};
}

/// Resampling scheme, and the effective share below which it resamples: always, when needed, never.
using OracleCase = std::tuple<std::string, double>;

class AgainstKalman : public ::testing::TestWithParam<OracleCase> {
 protected:
  static Moments run(std::uint64_t seed) {
    using Filter = ParticleFilter<State, State>;
    const auto& [scheme, ess_ratio] = GetParam();
    Filter::Parts parts{.size = std::make_unique<FixedSize<State>>(4000),
                        .resampling = make_resampling(scheme)};
    Filter filter(std::make_shared<const Cart>(), std::move(parts), std::make_shared<const Executor>(),
                  {.seed = seed, .resample_ess_ratio = ess_ratio});
    filter.initialize([](const RandomStream& random, std::uint32_t i) {
      const auto n = random.normal4(i);
      return State(kPriorMean[0] + kPriorSigma[0] * n[0], kPriorMean[1] + kPriorSigma[1] * n[1]);
    });
    for (const Step& step : kSteps) filter.update(step.u, position_seen(step.z));
    return moments_of(filter.particles());
  }
};

TEST_P(AgainstKalman, MeanAndCovariance) {
  const KalmanFilter<2> exact = kalman();
  std::vector<Moments> runs;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) runs.push_back(run(seed));
  const auto values = [&](auto number) {
    std::vector<double> v;
    v.reserve(runs.size());
    for (const Moments& m : runs) v.push_back(number(m));
    return v;
  };
  const Eigen::Matrix2d& P = exact.covariance();
  for (int i = 0; i < 2; ++i) {
    const double sigma = std::sqrt(P(i, i));
    expect_unbiased(values([i](const Moments& m) { return m.mean[i]; }), exact.mean()[i], 0.01 * sigma);
    for (int j = i; j < 2; ++j) {
      expect_unbiased(values([i, j](const Moments& m) { return m.covariance(i, j); }), P(i, j),
                      0.015 * sigma * std::sqrt(P(j, j)));
    }
  }
}

std::string name_of(const ::testing::TestParamInfo<OracleCase>& info) {
  const double ratio = std::get<1>(info.param);
  return std::get<0>(info.param) + (ratio == 1.0 ? "_always" : ratio == 0.0 ? "_never" : "_when_needed");
}

INSTANTIATE_TEST_SUITE_P(Schemes, AgainstKalman,
                         ::testing::Combine(::testing::ValuesIn(resampling_schemes()),
                                            ::testing::Values(1.0)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Triggers, AgainstKalman,
                         ::testing::Combine(::testing::Values("systematic"), ::testing::Values(0.5, 0.0)),
                         name_of);

// --- How far a door is open (examples/door_angle.hpp), against a grid over the angle.

constexpr double kPush = 0.15, kBeamSigma_m = 0.1, kSeconds = 0.5;

// The first beam misses the leaf: it rules out 25 to 65 degrees, which leaves two places. The second hits
// something that nobody knows of; the third looks elsewhere, but leaves both places, too.
std::vector<door::Beam> beams() {
  return {{{2.2, -1.0}, 0.75 * kPi, door::kFar_m},
          {{0.5, -1.5}, 0.50 * kPi, 0.7},
          {{2.2, -1.1}, 0.75 * kPi, door::kFar_m}};
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Probability of coming from the middle of one cell into another, by the images of the reflecting stops.
Eigen::MatrixXd pushed(int cells) {
  const double width = door::kWidest_rad / cells, sigma = kPush * std::sqrt(kSeconds);
  Eigen::MatrixXd transition = Eigen::MatrixXd::Zero(cells, cells);
  for (int from = 0; from < cells; ++from) {
    const double x = (from + 0.5) * width;
    for (const double image : {x, -x, 2.0 * door::kWidest_rad - x}) {
      for (int to = 0; to < cells; ++to)
        transition(to, from) +=
            normal_cdf(((to + 1) * width - image) / sigma) - normal_cdf((to * width - image) / sigma);
    }
    transition.col(from) /= transition.col(from).sum();
  }
  return transition;
}

/// Mean, variance, and the probabilities of four quarters.
using Summary = std::array<double, 6>;

Summary summary_of(const std::vector<double>& angles, const std::vector<double>& weights) {
  Summary s{};
  for (std::size_t i = 0; i < angles.size(); ++i) s[0] += weights[i] * angles[i];
  for (std::size_t i = 0; i < angles.size(); ++i) {
    s[1] += weights[i] * (angles[i] - s[0]) * (angles[i] - s[0]);
    const auto quarter =
        std::min<std::size_t>(3, static_cast<std::size_t>(angles[i] / door::kWidest_rad * 4.0));
    s[2 + quarter] += weights[i];
  }
  return s;
}

Summary by_grid(int cells) {
  std::vector<door::Opening> states;
  states.reserve(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) states.push_back({(i + 0.5) * door::kWidest_rad / cells});
  DiscreteFilter<door::Opening> filter(states);
  const Eigen::MatrixXd transition = pushed(cells);
  for (const door::Beam& beam : beams()) {
    filter.predict(transition);
    filter.correct(door::BeamOnDoor(kBeamSigma_m).bind(beam));
  }
  std::vector<double> angles;
  for (const door::Opening& s : filter.states()) angles.push_back(s.rad);
  return summary_of(angles, {filter.belief().begin(), filter.belief().end()});
}

Summary by_particles(std::uint64_t seed) {
  ParticleFilter<door::Opening, double> filter(std::make_shared<const door::PushedDoor>(kPush),
                                               std::make_unique<FixedSize<door::Opening>>(4000), nullptr,
                                               std::make_shared<const Executor>(), {.seed = seed});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    return door::Opening{door::kWidest_rad * random.uniform(i)};
  });
  for (const door::Beam& beam : beams()) filter.update(kSeconds, door::BeamOnDoor(kBeamSigma_m).bind(beam));
  std::vector<double> angles, weights;
  for (const door::Opening& s : filter.particles().states) angles.push_back(s.rad);
  for (const double w : filter.particles().log_weights) weights.push_back(std::exp(w));
  return summary_of(angles, weights);
}

TEST(AgainstAFineGrid, TheBeliefOverTheOpeningOfADoor) {
  const Summary fine = by_grid(480), coarse = by_grid(240);
  std::array<std::vector<double>, 6> values;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Summary s = by_particles(seed);
    for (std::size_t k = 0; k < s.size(); ++k) values[k].push_back(s[k]);
  }
  for (std::size_t k = 0; k < fine.size(); ++k) {
    // The finer grid is nearer to the truth than to the coarser one.
    expect_unbiased(values[k], fine[k], 0.003, std::abs(fine[k] - coarse[k]));
    EXPECT_LT(std::abs(fine[k] - coarse[k]), 0.004) << k;
  }
  // Two places, little between them: nothing that a mean and a variance describe.
  EXPECT_GT(fine[2], 3.0 * fine[3]);
  EXPECT_GT(fine[5], 3.0 * fine[4]);
  EXPECT_GT(std::min(fine[2], fine[5]), 0.2);
}

}  // namespace
}  // namespace cairn
