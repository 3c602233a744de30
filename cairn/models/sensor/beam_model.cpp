#include "cairn/models/sensor/beam_model.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kPerSqrtTwoPi = 0.3989422804014327;
constexpr double kLeastExpected_m = 1e-3;  // a ray that starts in a wall: keeps 1 - exp(-lambda r) above 0
constexpr double kBeyondReach_m = 1e9;     // the map's range of a ray that meets nothing
constexpr double kExplainedSigmas = 3.0;
constexpr double kLeastExplained_m = 0.15;
constexpr std::size_t kStatesAtOnce = 64;  // their ranges stay in the cache
// Factors that are multiplied before a logarithm is taken; each is at least kLeastProbability.
constexpr std::size_t kFactors = 16;
constexpr double kLeastProbability = 1e-15;

double beyond(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }  // P(N(0, 1) >= x)

double normal_density(double deviation) { return kPerSqrtTwoPi * std::exp(-0.5 * deviation * deviation); }

}  // namespace

void BeamModelOptions::visit(OptionVisitor& v) {
  const Range share{0.0, 1.0};
  v.number({"z_hit", "weight of readings of the map's wall", {"laser_z_hit"}}, z_hit, share);
  v.number({"z_short", "weight of readings of something in front of it", {"laser_z_short"}}, z_short, share);
  v.number({"z_max", "weight of readings without return", {"laser_z_max"}}, z_max, share);
  v.number({"z_rand", "weight of readings of anything", {"laser_z_rand"}}, z_rand, {1e-6, 1.0});
  v.number({"sigma_hit_m",
            "noise of readings of the wall, standard deviation, metres",
            {"sigma_hit", "laser_sigma_hit"}},
           sigma_hit_m, {1e-3, 10.0});
  v.number({"lambda_short_per_m",
            "decay of short readings with distance, 1/m",
            {"lambda_short", "laser_lambda_short"}},
           lambda_short_per_m, {1e-3, 100.0});
  v.integer({"max_beams",
             "evaluated beams per scan, spread evenly over the usable ones; 0: all",
             {"laser_max_beams"}},
            max_beams, {0, 100000});
  v.number({"effective_beams", "a scan never counts for more than this many independent beams"},
           effective_beams, {0.1, 100000});
}

BeamMixture::BeamMixture(const BeamModelOptions& o, double max_range_m)
    : sigma_m_(o.sigma_hit_m), lambda_per_m_(o.lambda_short_per_m), max_range_m_(max_range_m) {
  const double sum = o.z_hit + o.z_short + o.z_max + o.z_rand;
  hit_ = o.z_hit / sum;
  short_ = o.z_short / sum;
  max_ = o.z_max / sum;
  rand_ = o.z_rand / sum;
}

BeamMixture::Terms BeamMixture::terms(double z, double expected) const {
  const double r = std::max(expected, kLeastExpected_m);
  if (z >= max_range_m_) return {hit_ * beyond((max_range_m_ - r) / sigma_m_), 0.0, max_, 0.0};
  const double deviation = (z - r) / sigma_m_;
  const double hit = hit_ * normal_density(deviation) / sigma_m_;
  const double near = short_ * lambda_per_m_ * std::exp(-lambda_per_m_ * z) / -std::expm1(-lambda_per_m_ * r);
  return {hit, z <= r ? near : 0.0, 0.0, rand_ / max_range_m_};
}

double BeamMixture::log_likelihood(double z_m, double expected_m) const {
  return std::log(std::max(terms(z_m, expected_m).sum(), kLeastProbability));
}

// BeamMixture's functions of the map's range r, in steps of sigma / 64 and 2 cm. What they leave out is below
// 1e-13 of a term, but for short readings at r < 1 cm.
struct BeamModel::Tables {
  explicit Tables(const BeamModelOptions& options);

  // N(z; r, sigma) in 1/m, over |z - r|.
  double normal(double deviation_m) const { return at(normal_, deviation_m * steps_per_m_); }
  // P(N(r, sigma) >= z_max), over (z_max - r).
  double no_return(double below_reach_m) const {
    const double p = at(beyond_, std::abs(below_reach_m) * steps_per_m_);
    return below_reach_m > 0.0 ? p : 1.0 - p;
  }
  // 1 / (1 - exp(-lambda r)).
  double short_scale(double r_m) const { return at(short_scale_, r_m * kStepsPerMetre); }

 private:
  static constexpr double kStepsPerSigma = 64.0;
  static constexpr double kSigmas = 8.0;
  static constexpr double kStepsPerMetre = 50.0;
  static constexpr double kLargestExponent = 30.0;
  static constexpr double kMostSteps = 100'000;

  // The last value stands for all beyond.
  static double at(const std::vector<double>& table, double step) {
    const double last = static_cast<double>(table.size() - 1);
    return table[static_cast<std::size_t>(std::min(step + 0.5, last))];
  }

  double steps_per_m_;
  std::vector<double> normal_, beyond_, short_scale_;
};

BeamModel::Tables::Tables(const BeamModelOptions& o) : steps_per_m_(kStepsPerSigma / o.sigma_hit_m) {
  for (int i = 0; i <= static_cast<int>(kStepsPerSigma * kSigmas); ++i) {
    const double deviation = i / kStepsPerSigma;
    normal_.push_back(normal_density(deviation) / o.sigma_hit_m);
    beyond_.push_back(beyond(deviation));
  }
  normal_.push_back(0.0);
  beyond_.push_back(0.0);
  const double steps = std::min(kMostSteps, kStepsPerMetre * kLargestExponent / o.lambda_short_per_m);
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    const double r = std::max(i / kStepsPerMetre, kLeastExpected_m);
    short_scale_.push_back(-1.0 / std::expm1(-o.lambda_short_per_m * r));
  }
}

void expect_ranges(const RayMarcher& map, std::span<const Pose2> T_map_sensor,
                   std::span<const double> bearings_rad, std::span<float> ranges_m) {
  map.cast(T_map_sensor, bearings_rad, ranges_m);
  const auto most = static_cast<float>(map.max_range_m()), depth = static_cast<float>(0.5 * map.cell_m());
  for (float& range : ranges_m) range = range < most ? std::min(range + depth, most) : most;
}

// The beams of one scan with all that does not depend on the state.
class BeamModel::Beams {
 public:
  Beams(const BeamModel& model, const LaserScan& scan);

  void operator()(std::span<const Pose2> states, std::span<double> out) const {
    std::vector<Pose2> T_map_sensor;
    std::vector<float> expected;
    for (std::size_t begin = 0; begin < states.size(); begin += kStatesAtOnce) {
      const auto block = states.subspan(begin, std::min(kStatesAtOnce, states.size() - begin));
      T_map_sensor.clear();
      for (const Pose2& state : block) T_map_sensor.push_back(state * T_base_sensor_);
      expected.resize(block.size() * bearings_.size());
      expect_ranges(*map_, T_map_sensor, bearings_, expected);
      for (std::size_t i = 0; i < block.size(); ++i) {
        out[begin + i] = scale_ * score(std::span(expected).subspan(i * bearings_.size(), bearings_.size()));
      }
    }
  }

 private:
  double score(std::span<const float> expected) const {
    double sum = 0.0, product = 1.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double r = expected[k] < map_->max_range_m() ? expected[k] : kBeyondReach_m;
      const double p =
          k < returns_.size() ? probability(returns_[k], r) : max_ + hit_ * tables_->no_return(reach_m_ - r);
      product *= std::max(p, kLeastProbability);
      if ((k + 1) % kFactors != 0) continue;
      sum += std::log(product);
      product = 1.0;
    }
    return sum + std::log(product);
  }

  struct Return {
    double z_m;
    double unexpected;  ///< z_short lambda exp(-lambda z)
  };
  double probability(const Return& beam, double r) const {
    const double hit = hit_ * tables_->normal(std::abs(beam.z_m - r));
    return hit + (beam.z_m <= r ? beam.unexpected * tables_->short_scale(r) : 0.0) + rand_;
  }

  std::shared_ptr<const RayMarcher> map_;
  std::shared_ptr<const Tables> tables_;
  Pose2 T_base_sensor_;
  double reach_m_;
  double hit_, max_, rand_, scale_;
  std::vector<Return> returns_;
  std::vector<double> bearings_;  ///< of the returns, then of the beams without return
};

BeamModel::Beams::Beams(const BeamModel& model, const LaserScan& scan)
    : map_(model.map_),
      tables_(model.tables_),
      T_base_sensor_(model.T_base_sensor_),
      reach_m_(cairn::reach_m(scan, model.limits_)) {
  const BeamModelOptions& o = model.options_;
  const double weights = o.z_hit + o.z_short + o.z_max + o.z_rand;
  hit_ = o.z_hit / weights;
  max_ = o.z_max / weights;
  rand_ = o.z_rand / weights / reach_m_;
  std::vector<BeamReading> readings = select_readings(scan, model.limits_, o.max_beams);
  std::stable_partition(readings.begin(), readings.end(), [](const BeamReading& r) { return r.is_return; });
  for (const BeamReading& reading : readings) {
    bearings_.push_back(reading.bearing_rad);
    if (!reading.is_return) continue;
    const double decay = o.lambda_short_per_m * std::exp(-o.lambda_short_per_m * reading.range_m);
    returns_.push_back({reading.range_m, o.z_short / weights * decay});
  }
  scale_ = std::min(1.0, o.effective_beams / std::max<double>(1.0, static_cast<double>(readings.size())));
}

BeamModel::BeamModel(std::shared_ptr<const RayMarcher> map, const Pose2& T_base_sensor,
                     const BeamLimits& limits, const BeamModelOptions& options)
    : map_(std::move(map)),
      tables_(std::make_shared<const Tables>(options)),
      T_base_sensor_(T_base_sensor),
      limits_(limits),
      options_(options) {}

BoundUpdate<Pose2> BeamModel::bind(const LaserScan& scan) const { return {scan.stamp, Beams(*this, scan)}; }

double BeamModel::explained_share(const LaserScan& scan, const Pose2& T_map_base) const {
  const std::vector<BeamReading> readings = select_readings(scan, limits_, options_.max_beams);
  if (readings.empty()) return 0.0;
  std::vector<double> bearings;
  bearings.reserve(readings.size());
  for (const BeamReading& reading : readings) bearings.push_back(reading.bearing_rad);
  const Pose2 T_map_sensor = T_map_base * T_base_sensor_;
  std::vector<float> expected(readings.size());
  expect_ranges(*map_, std::span(&T_map_sensor, 1), bearings, expected);
  const double tolerance = std::max(kLeastExplained_m, kExplainedSigmas * options_.sigma_hit_m);
  const double reach = std::min(reach_m(scan, limits_), map_->max_range_m());
  std::size_t explained = 0;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const double map_range = std::min<double>(expected[k], reach);
    explained += std::abs(std::min(readings[k].range_m, reach) - map_range) <= tolerance ? 1 : 0;
  }
  return static_cast<double>(explained) / static_cast<double>(readings.size());
}

}  // namespace cairn
