#include "cairn/models/search/place_sampler.hpp"

#include "cairn/bayes/resampling/cumulative_weights.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/bayes/tempering.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kNeighbours = 256;
constexpr std::size_t kFewestCandidates = 4000;
constexpr std::size_t kCandidatesPerSample = 8;
// Progressive correction (Oudjane & Musso, FUSION 2000): the likelihood, much narrower than a cell, enters in
// portions that keep this effective share of the candidates; between them they are drawn again and moved a
// little.
constexpr double kLeastEssShare = 0.05;
constexpr int kMostPortions = 10;
constexpr double kNegligibleShare = 0.01;
constexpr double kFirstMove = 0.25;  // as a share of the cell
constexpr double kShrink = 0.7;
// The kernel over the signatures' distances is no narrower than what one moved chair does to a sector or two.
constexpr double kLeastWidth_m = 0.25;

/// A density over poses: constant on each of the neighbours' cells.
struct PlaceDensity {
  std::vector<PlaceIndex::Neighbour> neighbours;
  std::vector<double> log_weights;  ///< normalised
  std::vector<double> cumulative;
};

PlaceDensity density_around(const PlaceIndex& index, const ScanSignature& signature) {
  PlaceDensity density{index.nearest(signature, kNeighbours), {}, {}};
  const double width = std::max(kLeastWidth_m, static_cast<double>(density.neighbours.front().distance_m));
  for (const auto& n : density.neighbours) {
    const double d = n.distance_m / width;
    density.log_weights.push_back(-0.5 * d * d);
  }
  normalize_log_weights(density.log_weights);
  density.cumulative = cumulative_weights(density.log_weights);
  return density;
}

struct Candidates {
  std::vector<Pose2> poses;
  std::vector<double> log_weights;
};

// T_map_base of places of the scanner, drawn from the density; their weights are 1 / density.
Candidates draw(const PlaceIndex& index, const PlaceDensity& density, const Pose2& T_sensor_base,
                std::size_t count, const RandomStream& random) {
  Candidates drawn;
  drawn.poses.reserve(count);
  drawn.log_weights.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double u = random.uniform(i);
    const auto found = std::upper_bound(density.cumulative.begin(), density.cumulative.end(), u);
    const auto n = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
        found - density.cumulative.begin(), static_cast<std::ptrdiff_t>(density.cumulative.size()) - 1));
    const Pose2 pose = index.sample(density.neighbours[n].place, random, i) * T_sensor_base;
    drawn.poses.push_back({pose.x, pose.y, normalize_angle(pose.theta)});
    drawn.log_weights.push_back(-density.log_weights[n]);
  }
  return drawn;
}

/// Candidates that become samples of the likelihood.
class Refiner {
 public:
  Refiner(Candidates drawn, const BoundUpdate<Pose2>::LogLikelihood& log_likelihood,
          const RandomStream& random)
      : drawn_(std::move(drawn)), log_likelihood_(log_likelihood), random_(random) {}

  /// @param cell_m, cell_rad of the index
  std::vector<Pose2> refine(double cell_m, double cell_rad) {
    double left = 1.0, share = kFirstMove;
    for (std::uint16_t portion = 0; portion < kMostPortions && left > kNegligibleShare;
         ++portion, share *= kShrink) {
      left -= weigh(left);
      draw_again(portion);
      if (left > kNegligibleShare) move(share * cell_m, share * cell_rad, portion);
    }
    return std::move(drawn_.poses);
  }

 private:
  static constexpr std::uint16_t kFirstDraw = 8;  // random numbers below are for the candidates

  double weigh(double left) {
    log_likelihoods_.resize(drawn_.poses.size());
    log_likelihood_(drawn_.poses, log_likelihoods_);
    const double least_ess = kLeastEssShare * static_cast<double>(drawn_.poses.size());
    const double exponent = tempering_exponent(drawn_.log_weights, log_likelihoods_, least_ess, left);
    for (std::size_t i = 0; i < log_likelihoods_.size(); ++i)
      drawn_.log_weights[i] += exponent * log_likelihoods_[i];
    normalize_log_weights(drawn_.log_weights);
    return exponent;
  }

  void draw_again(std::uint16_t portion) {
    chosen_.clear();
    draw_systematic(cumulative_weights(drawn_.log_weights), drawn_.poses.size(),
                    random_.uniform(0, static_cast<std::uint16_t>(kFirstDraw + 2 * portion)), chosen_);
    std::vector<Pose2> next;
    next.reserve(chosen_.size());
    for (const std::uint32_t i : chosen_) next.push_back(drawn_.poses[i]);
    drawn_.poses = std::move(next);
    std::fill(drawn_.log_weights.begin(), drawn_.log_weights.end(), 0.0);
  }

  void move(double sigma_m, double sigma_rad, std::uint16_t portion) {
    for (std::uint32_t i = 0; i < drawn_.poses.size(); ++i) {
      const auto n = random_.normal4(i, static_cast<std::uint16_t>(kFirstDraw + 2 * portion + 1));
      Pose2& p = drawn_.poses[i];
      p = {p.x + sigma_m * n[0], p.y + sigma_m * n[1], normalize_angle(p.theta + sigma_rad * n[2])};
    }
  }

  Candidates drawn_;
  const BoundUpdate<Pose2>::LogLikelihood& log_likelihood_;
  RandomStream random_;
  std::vector<double> log_likelihoods_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace

struct PlaceSampler::Shared {
  std::shared_ptr<const OccupancyGrid> map;
  Pose2 T_sensor_base;
  BeamLimits limits;
  mutable std::once_flag once;
  mutable std::shared_ptr<const PlaceIndex> index;

  const PlaceIndex& index_for(const LaserScan& scan) const {
    std::call_once(once, [&] {
      if (!index) index = std::make_shared<const PlaceIndex>(*map, shape_of(scan), PlaceIndexOptions{});
    });
    return *index;
  }

  void sample(const LaserScan& scan, const BoundUpdate<Pose2>::LogLikelihood& log_likelihood,
              const RandomStream& random, std::span<Pose2> out) const {
    if (out.empty()) return;
    const PlaceIndex& places = index_for(scan);
    const PlaceDensity density = density_around(places, signature_of(scan, limits, places.shape()));
    const std::size_t count = std::max(kFewestCandidates, kCandidatesPerSample * out.size());
    const std::vector<Pose2> refined =
        Refiner(draw(places, density, T_sensor_base, count, random), log_likelihood, random)
            .refine(places.spacing_m(), places.heading_step_rad());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = refined[i * refined.size() / out.size()];
  }
};

PlaceSampler::PlaceSampler(std::shared_ptr<const OccupancyGrid> map, std::shared_ptr<const PlaceIndex> index,
                           const Pose2& T_base_sensor, const BeamLimits& limits) {
  auto shared = std::make_shared<Shared>();
  shared->map = std::move(map);
  shared->index = std::move(index);
  shared->T_sensor_base = inverse(T_base_sensor);
  shared->limits = limits;
  shared_ = std::move(shared);
}

BoundUpdate<Pose2>::Sample PlaceSampler::bind(std::shared_ptr<const LaserScan> scan,
                                              BoundUpdate<Pose2>::LogLikelihood log_likelihood) const {
  return [shared = shared_, scan = std::move(scan), log_likelihood = std::move(log_likelihood)](
             const RandomStream& random, std::span<Pose2> out) {
    shared->sample(*scan, log_likelihood, random, out);
  };
}

SignatureShape PlaceSampler::shape_of(const LaserScan& scan) {
  const double last =
      scan.angle_min_rad + scan.angle_increment_rad * (static_cast<double>(scan.ranges_m.size()) - 1.0);
  SignatureShape shape;
  shape.first_bearing_rad = std::min(scan.angle_min_rad, last);
  shape.last_bearing_rad = std::min(std::max(scan.angle_min_rad, last), shape.first_bearing_rad + kTwoPi);
  if (!(shape.last_bearing_rad > shape.first_bearing_rad)) return {};  // one beam: there is no field of view
  return shape;
}

}  // namespace cairn
