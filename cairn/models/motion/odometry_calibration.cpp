#include "cairn/models/motion/odometry_calibration.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/core/variance_components.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace cairn {
namespace {

constexpr std::size_t kBlock = 32;
constexpr std::size_t kLongest = 8;  // motions of a stretch; divides kBlock
constexpr std::size_t kFewest = 64;
constexpr int kRounds = 4;               // systematic and random part in turn
constexpr int kResampleIterations = 12;  // from the fit of the whole

// Motions that follow each other: what is drawn as one by the bootstrap.
using Block = std::span<const MotionPair>;

std::vector<Block> blocks_of(std::span<const MotionChain> chains) {
  std::vector<Block> blocks;
  for (const MotionChain& chain : chains) {
    for (std::size_t i = 0; i < chain.size(); i += kBlock) {
      blocks.push_back(Block(chain).subspan(i, std::min(kBlock, chain.size() - i)));
    }
  }
  return blocks;
}

// Sums over the motions of a stretch. Each motion counts in its own frame: an error of the heading does not
// spill over into the distance.
struct Stretch {
  double told_m = 0.0, true_m = 0.0;
  double told_rad = 0.0, true_rad = 0.0;
  double way_m = 0.0;
  double distance_m = 0.0, turned_rad = 0.0;  // forwards or backwards, left or right

  void add(const MotionPair& pair, double half_base_m) {
    const Twist2 told = log(pair.told), truth = log(pair.truth);
    told_m += told.x;
    true_m += truth.x;
    told_rad += told.theta;
    // The truth turns by no more than half a turn another way than the odometry says.
    true_rad += told.theta + normalize_angle(truth.theta - told.theta);
    const double distance = std::hypot(truth.x, truth.y), turned = std::abs(truth.theta);
    distance_m += distance;
    turned_rad += turned;
    way_m += distance + half_base_m * turned;
  }
};

std::vector<Stretch> stretches_of(std::span<const Block> blocks, std::size_t length, double half_base_m) {
  std::vector<Stretch> stretches;
  for (const Block& block : blocks) {
    for (std::size_t i = 0; i + length <= block.size(); i += length) {
      Stretch& stretch = stretches.emplace_back();
      for (const MotionPair& pair : block.subspan(i, length)) stretch.add(pair, half_base_m);
    }
  }
  return stretches;
}

struct Systematic {
  double distance = 1.0, turn = 1.0, drift = 0.0;

  double error_m(const Stretch& s) const { return s.told_m - distance * s.true_m; }
  double error_rad(const Stretch& s) const { return s.told_rad - turn * s.true_rad - drift * s.true_m; }
};

struct Random {
  VarianceFit metres, radians;  // component 0 grows with the way, 1 is constant

  static double variance(const VarianceFit& fit, const Stretch& s) {
    return std::max(1e-12, fit.component[0] * s.way_m + fit.component[1]);
  }
};

// Weight of an observation under the contaminated normal distribution of fit_variance_components.
double robust_weight(double error, double variance, double outliers) {
  const double good = (1.0 - outliers) * std::exp(-0.5 * error * error / variance);
  const double bad = 0.2 * outliers * std::exp(-0.02 * error * error / variance);
  const double is_bad = good + bad > 0.0 ? bad / (good + bad) : 1.0;
  return (1.0 - is_bad + 0.04 * is_bad) / variance;
}

Systematic fit_systematic(std::span<const Stretch> stretches, const Systematic& before,
                          const Random& random) {
  double mm = 0.0, mt = 0.0;
  // A robot that never turns (or never drives) leaves the factor at 1.
  constexpr double kLeast = 1e-9;
  Eigen::Matrix2d a = kLeast * Eigen::Matrix2d::Identity();
  Eigen::Vector2d b{kLeast, 0.0};
  for (const Stretch& s : stretches) {
    const double wm =
        robust_weight(before.error_m(s), Random::variance(random.metres, s), random.metres.outlier_share);
    mm += wm * s.true_m * s.true_m;
    mt += wm * s.true_m * s.told_m;
    const double wr =
        robust_weight(before.error_rad(s), Random::variance(random.radians, s), random.radians.outlier_share);
    const Eigen::Vector2d x{s.true_rad, s.true_m};
    a += wr * x * x.transpose();
    b += wr * x * s.told_rad;
  }
  const Eigen::Vector2d turn = a.ldlt().solve(b);
  return {mm > 0.0 ? mt / mm : 1.0, turn[0], turn[1]};
}

Random fit_random(std::span<const Block> blocks, const Systematic& systematic, double half_base_m,
                  const Random* start, int max_iterations) {
  std::vector<VarianceRow> metres, radians;
  for (std::size_t length = 1; length <= kLongest; length *= 2) {
    for (const Stretch& s : stretches_of(blocks, length, half_base_m)) {
      metres.push_back({systematic.error_m(s), 0.0, {s.way_m, 1.0, 0.0}});
      radians.push_back({systematic.error_rad(s), 0.0, {s.way_m, 1.0, 0.0}});
    }
  }
  if (start == nullptr) return {fit_variance_components(metres, 2), fit_variance_components(radians, 2)};
  return {fit_variance_components(metres, 2, {start->metres, max_iterations}),
          fit_variance_components(radians, 2, {start->radians, max_iterations})};
}

// The filter's own reading of a motion: turn, drive, turn (DifferentialDrive); errors along and across the
// driving direction and of the heading, to first order. Noise that does not grow with the motion is known.
struct FilterRows {
  std::vector<VarianceRow> along;    // components: alpha3, alpha4
  std::vector<VarianceRow> heading;  // components: alpha1, alpha2; the errors across belong here too

  void add(const MotionPair& pair, double constant_m2, double constant_rad2) {
    const NoisyMove move = DifferentialDrive(DifferentialDriveOptions{}).noisy_move(pair.told);
    const double drive2 = move.drive * move.drive;
    const double turn1 = move.turn1 * move.turn1, turns = turn1 + move.turn2 * move.turn2;
    const double c = std::cos(move.turn1), s = std::sin(move.turn1);
    const double dx = pair.truth.x - pair.told.x, dy = pair.truth.y - pair.told.y;
    along.push_back({c * dx + s * dy, constant_m2, {drive2, turns, 0.0}});
    heading.push_back(
        {angle_difference(pair.truth.theta, pair.told.theta), constant_rad2, {turns, 2.0 * drive2, 0.0}});
    if (move.turn1 == 0.0 && move.aside != 0.0) return;  // hardly moved: no direction to be across
    heading.push_back({c * dy - s * dx, constant_m2, {drive2 * turn1, drive2 * drive2, 0.0}});
  }
};

struct Values {
  Systematic systematic;
  Random random;
  std::array<VarianceFit, 2> constant;  // component 2, of metres and of radians
  VarianceFit along, heading;
};

// What does not grow with the motion, for noise that may grow otherwise with turning than with driving.
std::array<VarianceFit, 2> fit_constant(std::span<const Block> blocks, const Values* start) {
  std::vector<VarianceRow> metres, radians;
  for (std::size_t length = 1; length <= kLongest; length *= 2) {
    for (const Stretch& s : stretches_of(blocks, length, 0.0)) {
      metres.push_back({s.told_m - s.true_m, 0.0, {s.distance_m, s.turned_rad, 1.0}});
      radians.push_back({s.told_rad - s.true_rad, 0.0, {s.distance_m, s.turned_rad, 1.0}});
    }
  }
  if (start == nullptr) return {fit_variance_components(metres, 3), fit_variance_components(radians, 3)};
  return {fit_variance_components(metres, 3, {start->constant[0], kResampleIterations}),
          fit_variance_components(radians, 3, {start->constant[1], kResampleIterations})};
}

void fit_filter(std::span<const Block> blocks, const Values* start, Values& v) {
  v.constant = fit_constant(blocks, start);
  FilterRows rows;
  for (const Block& block : blocks) {
    for (const MotionPair& pair : block)
      rows.add(pair, v.constant[0].component[2], v.constant[1].component[2]);
  }
  VarianceFitOptions along, heading;
  if (start != nullptr) {
    along = {start->along, kResampleIterations};
    heading = {start->heading, kResampleIterations};
  }
  v.along = fit_variance_components(rows.along, 2, along);
  v.heading = fit_variance_components(rows.heading, 2, heading);
}

Values calibrate(std::span<const Block> blocks, double half_base_m) {
  Values v;
  const std::vector<Stretch> longest = stretches_of(blocks, kLongest, half_base_m);
  v.random = fit_random(blocks, v.systematic, half_base_m, nullptr, 0);
  for (int round = 0; round < kRounds; ++round) {
    v.systematic = fit_systematic(longest, v.systematic, v.random);
    const Random before = v.random;
    v.random = fit_random(blocks, v.systematic, half_base_m, &before, VarianceFitOptions{}.max_iterations);
  }
  fit_filter(blocks, nullptr, v);
  return v;
}

// The same for blocks that were drawn from those of `whole`.
Values calibrate_again(std::span<const Block> blocks, double half_base_m, const Values& whole) {
  Values v = whole;
  v.systematic = fit_systematic(stretches_of(blocks, kLongest, half_base_m), whole.systematic, whole.random);
  v.random = fit_random(blocks, v.systematic, half_base_m, &whole.random, kResampleIterations);
  fit_filter(blocks, &whole, v);
  return v;
}

constexpr std::size_t kValues = 11;

std::array<double, kValues> flat(const Values& v) {
  return {v.systematic.distance,
          v.systematic.turn,
          v.systematic.drift,
          std::sqrt(v.random.metres.component[0]),
          std::sqrt(v.random.radians.component[0]),
          std::sqrt(v.random.metres.component[1]),
          std::sqrt(v.random.radians.component[1]),
          v.heading.component[0],
          v.heading.component[1],
          v.along.component[0],
          v.along.component[1]};
}

// Standard deviations over samples of the blocks, drawn with replacement.
std::array<double, kValues> standard_errors(const std::vector<Block>& blocks, const Values& whole,
                                            const OdometryCalibrationOptions& options) {
  std::array<double, kValues> sum{}, squares{};
  for (int r = 0; r < options.resamples; ++r) {
    const RandomStream random(options.seed, RandomPurpose::kEvaluation, static_cast<std::uint64_t>(r));
    std::vector<Block> sample;
    sample.reserve(blocks.size());
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
      const auto drawn = static_cast<std::size_t>(random.uniform(i) * static_cast<double>(blocks.size()));
      sample.push_back(blocks[std::min(drawn, blocks.size() - 1)]);
    }
    const auto values = flat(calibrate_again(sample, 0.5 * options.wheel_base_m, whole));
    for (std::size_t k = 0; k < kValues; ++k) {
      sum[k] += values[k];
      squares[k] += values[k] * values[k];
    }
  }
  std::array<double, kValues> errors{};
  const double n = options.resamples;
  for (std::size_t k = 0; k < kValues && n > 1; ++k)
    errors[k] = std::sqrt(std::max(0.0, (squares[k] - sum[k] * sum[k] / n) / (n - 1.0)));
  return errors;
}

// Where the odometry has gone or turned far enough since the last cut.
bool is_far(const Pose2& motion, const MotionCutting& options) {
  return std::hypot(motion.x, motion.y) >= options.step_m || std::abs(motion.theta) >= options.step_rad;
}

std::optional<Pose2> reference_at(const Trajectory& reference, Time stamp, Duration max_gap) {
  const auto after = std::lower_bound(reference.begin(), reference.end(), stamp,
                                      [](const StampedPose& p, Time t) { return p.stamp < t; });
  const bool between = after != reference.begin() && after != reference.end() && after->stamp != stamp;
  if (between && after->stamp - (after - 1)->stamp > max_gap) return std::nullopt;
  return pose_at(reference, stamp);
}

}  // namespace

std::vector<MotionChain> cut_motions(const Trajectory& odometry, const Trajectory& reference,
                                     const MotionCutting& options) {
  if (!(options.step_m > 0.0) || !(options.step_rad > 0.0))
    throw ConfigurationError("step", "is not positive", "give metres and radians");
  std::vector<MotionChain> chains;
  std::optional<std::pair<Pose2, Pose2>> from;  // odometry and reference at the last cut
  Time last{};
  for (const StampedPose& told : odometry) {
    const auto truth = reference_at(reference, told.stamp, options.max_gap);
    if (!truth || (from && told.stamp - last > options.max_gap)) from.reset();
    last = told.stamp;
    if (!truth) continue;
    if (!from) {
      from.emplace(told.pose, *truth);
      chains.emplace_back();
      continue;
    }
    const Pose2 motion = between(from->first, told.pose);
    if (!is_far(motion, options)) continue;
    chains.back().push_back({motion, between(from->second, *truth)});
    from.emplace(told.pose, *truth);
  }
  std::erase_if(chains, [](const MotionChain& chain) { return chain.empty(); });
  return chains;
}

DifferentialDriveOptions OdometryCalibration::motion_options() const {
  DifferentialDriveOptions options;
  options.alpha1 = alpha1.value;
  options.alpha2 = alpha2.value;
  options.alpha3 = alpha3.value;
  options.alpha4 = alpha4.value;
  return options;
}

OdometryCalibration calibrate_odometry(std::span<const MotionChain> chains,
                                       const OdometryCalibrationOptions& options) {
  if (!(options.wheel_base_m > 0.0)) throw ConfigurationError("wheel base", "is not positive", "give metres");
  const std::vector<Block> blocks = blocks_of(chains);
  OdometryCalibration result;
  for (const Stretch& s : stretches_of(blocks, 1, 0.5 * options.wheel_base_m)) {
    ++result.motions;
    result.way_m += s.way_m;
  }
  if (result.motions < kFewest || stretches_of(blocks, kLongest, 0.0).empty()) {
    throw InputError(
        "odometry", "there are only " + std::to_string(result.motions) + " motions with a reference",
        "64 and more in a row are needed: check that log and reference are of the same run and clock");
  }
  const Values fitted = calibrate(blocks, 0.5 * options.wheel_base_m);
  const auto value = flat(fitted), error = standard_errors(blocks, fitted, options);
  Estimated* const out[kValues] = {&result.distance_factor,
                                   &result.turn_factor,
                                   &result.drift_rad_per_m,
                                   &result.sigma_per_sqrt_metre_m,
                                   &result.sigma_per_sqrt_metre_rad,
                                   &result.sigma_constant_m,
                                   &result.sigma_constant_rad,
                                   &result.alpha1,
                                   &result.alpha2,
                                   &result.alpha3,
                                   &result.alpha4};
  for (std::size_t k = 0; k < kValues; ++k) *out[k] = {value[k], error[k]};
  result.outlier_share = std::max(fitted.random.metres.outlier_share, fitted.random.radians.outlier_share);
  return result;
}

}  // namespace cairn
