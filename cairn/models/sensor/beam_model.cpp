#include "cairn/models/sensor/beam_model.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/sensor/beam_mixture_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace cairn {
namespace {

constexpr double kPerSqrtTwoPi = 0.3989422804014327;
constexpr double kLeastExpected_m = 1e-3;  // a ray that starts in a wall: keeps 1 - exp(-lambda r) above 0
constexpr double kExplainedSigmas = 3.0;
constexpr double kLeastExplained_m = 0.15;
constexpr double kLargestHeading = 1e5;  // beyond, angles are brought into [-pi, pi) first

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
  return std::log(std::max<double>(terms(z_m, expected_m).sum(), kLeastProbability));
}

// P(N(0, 1) >= x), in steps of 1 / 64.
class BeamModel::NormalTail {
 public:
  NormalTail() {
    for (int i = 0; i <= static_cast<int>(kStepsPerSigma * kSigmas); ++i)
      values_.push_back(beyond(i / kStepsPerSigma));
    values_.push_back(0.0);  // stands for all beyond
  }

  double operator()(double x) const {
    const double last = static_cast<double>(values_.size() - 1);
    const double p = values_[static_cast<std::size_t>(std::min(std::abs(x) * kStepsPerSigma + 0.5, last))];
    return x > 0.0 ? p : 1.0 - p;
  }

 private:
  static constexpr double kStepsPerSigma = 64.0;
  static constexpr double kSigmas = 8.0;

  std::vector<double> values_;
};

namespace {

double depth_of_walls(const RayMarcher& map) { return 0.5 * map.cell_m(); }

}  // namespace

void expect_ranges(const RayMarcher& map, std::span<const Pose2> T_map_sensor,
                   std::span<const double> bearings_rad, std::span<float> ranges_m) {
  map.cast(T_map_sensor, bearings_rad, ranges_m);
  const auto most = static_cast<float>(map.max_range_m()), depth = static_cast<float>(depth_of_walls(map));
  for (float& range : ranges_m) range = range < most ? std::min(range + depth, most) : most;
}

namespace {

// The indices of the states, from the least heading to the largest. Any order gives the same results.
std::vector<std::uint32_t> by_heading(std::span<const Pose2> states) {
  std::vector<std::pair<float, std::uint32_t>> keys(states.size());
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    const double heading = states[i].theta;
    keys[i] = {static_cast<float>(std::abs(heading) < kLargestHeading ? heading : 0.0), i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(states.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace

// The beams of one scan with all that does not depend on the state.
class BeamModel::Beams {
 public:
  Beams(const BeamModel& model, const LaserScan& scan);
  Beams(const BeamModel& model, double reach_m, const std::vector<BeamReading>& readings);

  // States of like headings side by side: their rays take as many steps.
  void operator()(std::span<const Pose2> states, std::span<double> out) const {
    const std::vector<std::uint32_t> order = by_heading(states);
    // Rows of as many ranges as there are states; the last one is read to its capacity.
    std::vector<float> ranges(kAtOnce * (bearings_.size() + 1));
    Poses some;
    for (std::size_t begin = 0; begin < states.size(); begin += kAtOnce) {
      const auto places = std::span(order).subspan(begin, std::min(kAtOnce, states.size() - begin));
      for (std::size_t i = 0; i < places.size(); ++i) some[i] = states[places[i]];
      const BeamProducts products = weigh(std::span(some).first(places.size()), ranges);
      for (std::size_t i = 0; i < places.size(); ++i) out[places[i]] = scale_ * products.log(i);
    }
  }

 private:
  static constexpr std::size_t kAtOnce = BeamProducts::kCapacity;
  using Poses = std::array<Pose2, kAtOnce>;

  BeamProducts weigh(std::span<const Pose2> states, std::span<float> ranges) const {
    const Poses T_map_sensor = sensors_at(states);
    const std::size_t count = states.size();
    map_->cast_by_bearing(std::span(T_map_sensor).first(count), bearings_,
                          ranges.first(count * bearings_.size()));
    BeamProducts products;
    products.begin();
    for (std::size_t k = 0; k < bearings_.size(); ++k) {
      const float* const expected = &ranges[k * count];
      if (k < returns_.size()) {
        multiply_return(causes_, returns_[k].z_m, returns_[k].unexpected, expected, products);
      } else {
        multiply_no_return(expected, products);
      }
    }
    return products;
  }

  // Where the sensors are, as many as there are states.
  Poses sensors_at(std::span<const Pose2> states) const;
  void multiply_no_return(const float* ranges_m, BeamProducts& products) const;

  struct Return {
    float z_m;
    float unexpected;  ///< z_short lambda exp(-lambda z)
  };

  std::shared_ptr<const RayMarcher> map_;
  std::shared_ptr<const NormalTail> tail_;
  Pose2 T_base_sensor_;
  BeamCauses causes_;
  double reach_m_, sigma_m_, hit_, max_, scale_;
  std::vector<Return> returns_;
  RayBearings bearings_;  ///< of the returns, then of the beams without return
};

namespace {

std::vector<BeamReading> returns_first(std::vector<BeamReading> readings) {
  std::stable_partition(readings.begin(), readings.end(), [](const BeamReading& r) { return r.is_return; });
  return readings;
}

RayBearings bearings_of(const std::vector<BeamReading>& readings) {
  std::vector<double> bearings;
  bearings.reserve(readings.size());
  for (const BeamReading& reading : readings) bearings.push_back(reading.bearing_rad);
  return RayBearings(bearings);
}

}  // namespace

BeamModel::Beams::Beams(const BeamModel& model, const LaserScan& scan)
    : Beams(model, reach_m(scan, model.limits_),
            returns_first(select_readings(scan, model.limits_, model.options_.max_beams))) {}

BeamModel::Beams::Beams(const BeamModel& model, double reach_m, const std::vector<BeamReading>& readings)
    : map_(model.map_),
      tail_(model.tail_),
      T_base_sensor_(model.T_base_sensor_),
      reach_m_(reach_m),
      sigma_m_(model.options_.sigma_hit_m),
      bearings_(bearings_of(readings)) {
  const BeamModelOptions& o = model.options_;
  const double weights = o.z_hit + o.z_short + o.z_max + o.z_rand;
  hit_ = o.z_hit / weights;
  max_ = o.z_max / weights;
  causes_ = {.hit = static_cast<float>(hit_ * normal_density(0.0) / sigma_m_),
             .per_sigma = static_cast<float>(1.0 / sigma_m_),
             .lambda_per_m = static_cast<float>(o.lambda_short_per_m),
             .rand = static_cast<float>(o.z_rand / weights / reach_m_),
             .depth_m = static_cast<float>(depth_of_walls(*map_)),
             .max_range_m = static_cast<float>(map_->max_range_m())};
  for (const BeamReading& reading : readings) {
    if (!reading.is_return) break;
    const double decay = o.lambda_short_per_m * std::exp(-o.lambda_short_per_m * reading.range_m);
    returns_.push_back(
        {static_cast<float>(reading.range_m), static_cast<float>(o.z_short / weights * decay)});
  }
  scale_ = std::min(1.0, o.effective_beams / std::max<double>(1.0, static_cast<double>(readings.size())));
}

BeamModel::Beams::Poses BeamModel::Beams::sensors_at(std::span<const Pose2> states) const {
  std::array<double, BeamProducts::kCapacity> headings{}, sines, cosines;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double heading = states[i].theta;
    headings[i] = std::abs(heading) < kLargestHeading ? heading : normalize_angle(heading);
  }
  sine_cosine_all(headings, sines, cosines);
  Poses poses;
  const Pose2& T = T_base_sensor_;
  for (std::size_t i = 0; i < states.size(); ++i) {
    poses[i] = {states[i].x + cosines[i] * T.x - sines[i] * T.y,
                states[i].y + sines[i] * T.x + cosines[i] * T.y, headings[i] + T.theta};
  }
  return poses;
}

void BeamModel::Beams::multiply_no_return(const float* ranges_m, BeamProducts& products) const {
  std::array<float, BeamProducts::kCapacity> probabilities;
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    const float middle = ranges_m[i] + causes_.depth_m;
    const double tail = middle < causes_.max_range_m ? (*tail_)((reach_m_ - middle) / sigma_m_) : 1.0;
    probabilities[i] = static_cast<float>(max_ + hit_ * tail);
  }
  multiply(probabilities.data(), products);
}

BeamModel::BeamModel(std::shared_ptr<const RayMarcher> map, const Pose2& T_base_sensor,
                     const BeamLimits& limits, const BeamModelOptions& options)
    : map_(std::move(map)),
      tail_(std::make_shared<const NormalTail>()),
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
