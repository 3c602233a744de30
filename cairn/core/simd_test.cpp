#include "cairn/core/simd.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Simd, NamesAndPathsAreOneToOne) {
  for (const SimdPath path : available_simd_paths()) EXPECT_EQ(simd_path_named(name_of(path)), path);
  EXPECT_FALSE(simd_path_named("mmx").has_value());
  EXPECT_FALSE(simd_path_named("").has_value());
}

TEST(Simd, StartsWithTheBestAndKeepsToALimit) {
  const std::vector<SimdPath> paths = available_simd_paths();
  ASSERT_FALSE(paths.empty());
  EXPECT_EQ(paths.front(), SimdPath::kScalar);
  EXPECT_EQ(simd_path(), paths.back());
  for (const SimdPath path : paths) {
    limit_simd_path(path);
    EXPECT_EQ(simd_path(), path);
  }
  EXPECT_EQ(available_simd_paths(), paths);
  limit_simd_path(paths.front());
  EXPECT_EQ(available_simd_paths(), paths);
  limit_simd_path(SimdPath::kAvx512);
  EXPECT_EQ(simd_path(), paths.back());
}

}  // namespace
}  // namespace cairn
