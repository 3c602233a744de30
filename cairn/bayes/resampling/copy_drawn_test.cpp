#include "cairn/bayes/resampling/copy_drawn.hpp"

#include "simd_paths.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<Pose2> some_states(std::size_t n) {
  std::vector<Pose2> states;
  for (std::size_t i = 0; i < n; ++i) {
    const auto x = static_cast<double>(i);
    states.push_back({x, x + 0.25, x + 0.5});
  }
  return states;
}

// Around the first and the last state nothing may be read, around the copies nothing written.
TEST(CopyDrawn, EveryPathCopiesWholePosesAndNothingElse) {
  const std::vector<Pose2> states = some_states(50);
  const std::vector<std::uint32_t> ancestors = {49, 0,  49, 3,  1,  2,  3, 3, 4,  48, 48, 1, 17, 30, 2,
                                                0,  16, 17, 17, 18, 40, 1, 9, 49, 49, 20, 8, 7,  6,  5};
  const Pose2 untouched{-1, -2, -3};
  test::on_every_simd_path([&](SimdPath path) {
    for (std::size_t count = 0; count <= ancestors.size(); ++count) {
      std::vector<Pose2> out(ancestors.size() + 1, untouched);
      copy_drawn(std::span<const Pose2>(states), std::span(ancestors).first(count),
                 std::span(out).first(count));
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(out[i], states[ancestors[i]]) << name_of(path);
      EXPECT_EQ(out[count], untouched) << name_of(path) << ' ' << count;
    }
  });
}

TEST(CopyDrawn, SetsOfOneAndTwoStates) {
  const std::vector<std::uint32_t> ancestors = {0, 1, 1, 0, 0, 1, 0};
  const std::vector<std::uint32_t> zeros(7, 0);
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t n : {1u, 2u, 3u}) {
      const std::vector<Pose2> states = some_states(n);
      std::vector<Pose2> out(7);
      copy_drawn(std::span<const Pose2>(states), n == 1 ? zeros : ancestors, std::span(out));
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_EQ(out[i], states[n == 1 ? 0 : ancestors[i]]) << name_of(path);
    }
  });
}

TEST(CopyDrawn, OtherStatesToo) {
  const std::vector<int> states = {10, 11, 12};
  const std::vector<std::uint32_t> ancestors = {2, 0, 2, 1};
  std::vector<int> out(4);
  copy_drawn<int>(states, ancestors, out);
  EXPECT_EQ(out, (std::vector<int>{12, 10, 12, 11}));
}

}  // namespace
}  // namespace cairn
