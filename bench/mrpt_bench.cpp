// The peer: MRPT's likelihood field (LF_Thrun) and its Gaussian motion model, on the same map, scan and
// particles.
#include "bench_world.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "registration.hpp"

#include <cmath>

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPosePDFParticles.h>

namespace cairn::bench {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

// The options that make MRPT do the same work as LikelihoodField: every beam, distances up to 2 m, and
// log(z_hit exp(..) + z_rand), which MRPT writes as z_rand / LF_maxRange.
void set_options(COccupancyGridMap2D::TLikelihoodOptions& mrpt, const LikelihoodFieldOptions& cairn) {
  mrpt.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
  mrpt.LF_decimation = 1;
  mrpt.LF_maxCorrsDistance = static_cast<float>(cairn.max_distance_m);
  mrpt.LF_stdHit = static_cast<float>(cairn.sigma_hit_m);
  mrpt.LF_zHit = static_cast<float>(cairn.z_hit);
  mrpt.LF_zRandom = static_cast<float>(cairn.z_rand);
  mrpt.LF_maxRange = 1.0f;
  mrpt.LF_useSquareDist = false;
  mrpt.LF_alternateAverageMethod = false;
  mrpt.enableLikelihoodCache = true;
}

COccupancyGridMap2D mrpt_map(const OccupancyGrid& map) {
  const GridGeometry& g = map.geometry();
  COccupancyGridMap2D result(0.0f, static_cast<float>(g.width * g.resolution_m), 0.0f,
                             static_cast<float>(g.height * g.resolution_m),
                             static_cast<float>(g.resolution_m));
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      const bool occupied = map.state(g.index(column, row)) == CellState::kOccupied;
      result.setCell(column, row, occupied ? 0.01f : 0.99f);  // probability of being free
    }
  }
  set_options(result.likelihoodOptions, LikelihoodFieldOptions{});
  return result;
}

CObservation2DRangeScan mrpt_scan(const LaserScan& scan) {
  CObservation2DRangeScan result;
  result.aperture =
      static_cast<float>(scan.angle_increment_rad * static_cast<double>(scan.ranges_m.size() - 1));
  result.rightToLeft = true;
  result.maxRange = static_cast<float>(scan.range_max_m);
  result.resizeScan(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    result.setScanRange(i, scan.ranges_m[i]);
    result.setScanRangeValidity(i, scan.is_valid_range(scan.ranges_m[i]));
  }
  return result;
}

std::vector<CPose3D> mrpt_poses(const std::vector<Pose2>& states) {
  std::vector<CPose3D> poses;
  for (const Pose2& pose : states) poses.emplace_back(pose.x, pose.y, 0.0, pose.theta, 0.0, 0.0);
  return poses;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i], sb += b[i];
    saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
  }
  return (n * sab - sa * sb) / std::sqrt((n * saa - sa * sa) * (n * sbb - sb * sb));
}

// Both must compute the same thing for a comparison to mean something. The first pass also warms MRPT's cache
// of cells.
double agreement(COccupancyGridMap2D& map, const CObservation2DRangeScan& scan,
                 const std::vector<CPose3D>& poses, const std::vector<Pose2>& states) {
  LikelihoodFieldOptions options;
  options.max_beams = 0;
  const auto field = std::make_shared<const DistanceField>(*bench_world().map, options.max_distance_m);
  std::vector<double> ours(states.size());
  LikelihoodField(field, {}, {}, options).log_likelihood(bench_world().scan, states, ours);
  std::vector<double> theirs;
  for (const CPose3D& pose : poses) theirs.push_back(map.computeObservationLikelihood(scan, pose));
  return correlation(ours, theirs);
}

void weigh(benchmark::State& state, std::vector<Pose2> (*particles)(std::size_t)) {
  COccupancyGridMap2D map = mrpt_map(*bench_world().map);
  const CObservation2DRangeScan scan = mrpt_scan(bench_world().scan);
  const std::vector<Pose2> states = particles(static_cast<std::size_t>(state.range(0)));
  const std::vector<CPose3D> poses = mrpt_poses(states);
  const double agrees = agreement(map, scan, poses, states);
  if (!(agrees > 0.99)) return state.SkipWithError("MRPT computes something else: no comparison");
  for (auto _ : state) {
    for (const CPose3D& pose : poses) benchmark::DoNotOptimize(map.computeObservationLikelihood(scan, pose));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(bench_world().scan.ranges_m.size()));
  state.counters["correlation"] = agrees;
}

// Every beam is simulated and compared.
void weigh_by_rays(benchmark::State& state) {
  COccupancyGridMap2D map = mrpt_map(*bench_world().map);
  map.likelihoodOptions.likelihoodMethod = COccupancyGridMap2D::lmRayTracing;
  map.likelihoodOptions.rayTracing_decimation = 1;
  const CObservation2DRangeScan scan = mrpt_scan(bench_world().scan);
  const auto poses = mrpt_poses(tracking_particles(static_cast<std::size_t>(state.range(0))));
  for (auto _ : state) {
    for (const CPose3D& pose : poses) benchmark::DoNotOptimize(map.computeObservationLikelihood(scan, pose));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(bench_world().scan.ranges_m.size()));
}

struct ForgetfulMap : COccupancyGridMap2D {
  explicit ForgetfulMap(const COccupancyGridMap2D& map) : COccupancyGridMap2D(map) {}
  void forget() { m_likelihoodCacheOutDated = true; }
};

// The likelihoods of all cells, from a cold cache: MRPT works out the distance of a cell when it is first
// asked.
void fill_likelihood_grid(benchmark::State& state) {
  const auto grid = square_map(static_cast<int>(state.range(0)));
  ForgetfulMap map(mrpt_map(*grid));
  map.likelihoodOptions.LF_maxCorrsDistance = 0.3f;
  const GridGeometry& g = grid->geometry();
  mrpt::maps::CSimplePointsMap centres;
  centres.reserve(g.size());
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column)
      centres.insertPointFast(map.idx2x(column), map.idx2y(row));
  }
  for (auto _ : state) {
    map.forget();
    benchmark::DoNotOptimize(map.computeLikelihoodField_Thrun(&centres));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(g.size()));
}

// Turn, drive, turn with noise on each (Thrun), as ours.
CActionRobotMovement2D odometry_motion() {
  CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = CActionRobotMovement2D::mmThrun;
  CActionRobotMovement2D motion;
  motion.computeFromOdometry(CPose2D(0.1, 0.0, 0.02), options);
  motion.prepareFastDrawSingleSamples();
  return motion;
}

void sample_motion(benchmark::State& state) {
  std::vector<CPose2D> states;
  for (const Pose2& pose : tracking_particles(static_cast<std::size_t>(state.range(0)))) {
    states.emplace_back(pose.x, pose.y, pose.theta);
  }
  for (auto _ : state) {
    const CActionRobotMovement2D motion = odometry_motion();
    for (CPose2D& pose : states) {
      CPose2D increment;
      motion.fastDrawSingleSample(increment);
      pose = pose + increment;
    }
    benchmark::DoNotOptimize(states.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

mrpt::poses::CPosePDFParticles particle_set(std::size_t count) {
  mrpt::poses::CPosePDFParticles particles(count);
  const std::vector<Pose2> states = tracking_particles(count);
  for (std::size_t i = 0; i < count; ++i)
    particles.m_particles[i].d = mrpt::math::TPose2D(states[i].x, states[i].y, states[i].theta);
  return particles;
}

mrpt::bayes::CParticleFilter::TParticleFilterOptions systematic() {
  mrpt::bayes::CParticleFilter::TParticleFilterOptions options;
  options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  return options;
}

void resample(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  mrpt::poses::CPosePDFParticles particles = particle_set(count);
  const auto options = systematic();
  const RandomStream random(1, RandomPurpose::kTest, 1);
  std::vector<double> log_weights(count);
  for (std::size_t i = 0; i < count; ++i) log_weights[i] = random.normal4(static_cast<std::uint32_t>(i))[0];
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) particles.m_particles[i].log_w = log_weights[i];
    particles.performResampling(options);
    benchmark::DoNotOptimize(particles.m_particles.front().log_w);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// One map for all repetitions, so that its cache of cells is warm.
COccupancyGridMap2D& warm_map() {
  static COccupancyGridMap2D map = [] {
    COccupancyGridMap2D made = mrpt_map(*bench_world().map);
    const CObservation2DRangeScan scan = mrpt_scan(bench_world().scan);
    for (const CPose3D& pose : mrpt_poses(tracking_particles(20'000)))
      made.computeObservationLikelihood(scan, pose);
    return made;
  }();
  return map;
}

// Motion, weights, mean, resampling: what MRPT's own localization does in one step.
void whole_step(benchmark::State& state) {
  COccupancyGridMap2D& map = warm_map();
  const CObservation2DRangeScan scan = mrpt_scan(bench_world().scan);
  mrpt::poses::CPosePDFParticles particles = particle_set(static_cast<std::size_t>(state.range(0)));
  const auto options = systematic();
  CActionRobotMovement2D::TMotionModelOptions noise;
  noise.modelSelection = CActionRobotMovement2D::mmThrun;
  double direction = 1.0;
  for (auto _ : state) {
    CActionRobotMovement2D motion;
    motion.computeFromOdometry(CPose2D(0.1 * direction, 0.0, 0.02 * direction), noise);
    motion.prepareFastDrawSingleSamples();
    for (auto& particle : particles.m_particles) {
      CPose2D increment;
      motion.fastDrawSingleSample(increment);
      const CPose2D moved = CPose2D(particle.d) + increment;
      particle.d = moved.asTPose();
      // A scan counts as twenty beams of its sixty, here as there.
      particle.log_w += map.computeObservationLikelihood(scan, CPose3D(moved)) / 3.0;
    }
    particles.normalizeWeights();
    benchmark::DoNotOptimize(particles.getCovarianceAndMean());
    particles.performResampling(options);
    direction = -direction;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

void register_peer() {
  of_peer("likelihood_field_tracking", {500, 2000, 10000},
          [](auto& state) { weigh(state, tracking_particles); });
  of_peer("likelihood_field_global", {10000}, [](auto& state) { weigh(state, global_particles); });
  of_peer("beam_model_tracking", {500}, weigh_by_rays);
  of_peer("distance_field_30cm", {1000, 4000}, fill_likelihood_grid);
  of_peer("motion_sampling", {2000}, sample_motion);
  of_peer("resample_kld", {2000}, resample);
  of_peer("whole_step", {500, 2000, 10000}, whole_step);
}

}  // namespace cairn::bench
