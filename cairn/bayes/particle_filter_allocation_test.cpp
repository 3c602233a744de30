// A filter that has found its size allocates no more: on a robot, the time that an allocation takes is a
// surprise.
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/core/angle.hpp"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

#include <gtest/gtest.h>

namespace {
std::atomic<std::size_t> allocations{0};
}

// Counts what this program allocates. The array forms of the library call these. Not inlined: g++ 12 takes
// the inlined free() for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}
// AddressSanitizer has a form of its own that does not throw; delete must not meet its memory.
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace cairn {
namespace {

struct NoisyMove final : MotionModel<Pose2, Pose2> {
  void propagate(const Pose2& u, std::span<Pose2> states, const RandomStream& random) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto n = random.normal4(static_cast<std::uint32_t>(i));
      states[i] = states[i] * u * Pose2{0.02 * n[0], 0.02 * n[1], 0.02 * n[2]};
    }
  }
};

using Filter = ParticleFilter<Pose2, Pose2>;

BoundUpdate<Pose2> near_to(double x, double sigma) {
  return {Time{}, [=](std::span<const Pose2> poses, std::span<double> out) {
            for (std::size_t i = 0; i < poses.size(); ++i) {
              const double d = std::hypot(poses[i].x - x, poses[i].y, poses[i].theta);
              out[i] = -d * d / (2.0 * sigma * sigma);
            }
          }};
}

struct Case {
  std::string scheme;
  bool kld;
};

class ParticleFilterAllocation : public ::testing::TestWithParam<Case> {};

TEST_P(ParticleFilterAllocation, NoneOnceItHasFoundItsSize) {
  std::unique_ptr<SampleSize<Pose2>> size = std::make_unique<FixedSize<Pose2>>(500);
  if (GetParam().kld) size = std::make_unique<KldSize>(KldOptions{}, 200, 2000);
  Filter filter(std::make_shared<const NoisyMove>(),
                {.size = std::move(size),
                 .resampling = make_resampling(GetParam().scheme),
                 .regularization = std::make_unique<PoseKernel>(PoseKernelOptions{})},
                std::make_shared<const Executor>(), {.seed = 1, .min_ess_share = 0.15});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.1 * n[0], 0.1 * n[1], 0.05 * n[2]};
  });
  const BoundUpdate<Pose2> here = near_to(0.0, 0.05), sharp = near_to(0.02, 0.004);
  Filter::Checkpoint checkpoint;
  const auto round = [&] {
    filter.save(checkpoint);
    filter.update({0.05, 0.0, 0.0}, here);
    filter.predict({-0.05, 0.0, 0.0});
    filter.correct(sharp);  // in portions
    filter.correct(here);
    filter.restore(checkpoint);
    filter.update({0.0, 0.0, 0.0}, here);
  };
  for (int k = 0; k < 30; ++k) round();
  const std::size_t before = allocations;
  for (int k = 0; k < 30; ++k) round();
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(before, 0u);  // it does count
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& scheme : resampling_schemes()) {
    all.push_back({scheme, false});
    all.push_back({scheme, true});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Schemes, ParticleFilterAllocation, ::testing::ValuesIn(cases()),
                         [](const auto& chosen) {
                           return chosen.param.scheme + (chosen.param.kld ? "_kld" : "");
                         });

}  // namespace
}  // namespace cairn
