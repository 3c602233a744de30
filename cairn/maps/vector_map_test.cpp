#include "cairn/maps/vector_map.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

std::string error_of(std::vector<Wall> walls) {
  try {
    const VectorMap map(std::move(walls));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(VectorMap, KnowsItsBoundsAndMaterials) {
  const VectorMap map({{{1, 2}, {4, 6}, Material::kGlass}, {{-1, 0}, {-1, 3}}});
  EXPECT_EQ(map.bounds().min, (Point2{-1, 0}));
  EXPECT_EQ(map.bounds().max, (Point2{4, 6}));
  EXPECT_DOUBLE_EQ(map.length_m(), 8.0);
  EXPECT_EQ(map.count(Material::kGlass), 1u);
  EXPECT_EQ(map.count(Material::kOpaque), 1u);
  EXPECT_EQ(map.count(Material::kMirror), 0u);
}

TEST(VectorMap, RefusesWhatIsNoMap) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of({}), HasSubstr("has no wall"));
  EXPECT_THAT(error_of({{{0, 0}, {1, 1}}, {{1, 1}, {1, 1}}}), HasSubstr("wall 1: has no length"));
  for (const double bad : {nan, infinity, -infinity, 1.1e7}) {
    EXPECT_THAT(error_of({{{0, 0}, {1, bad}}}), HasSubstr("wall 0: has a coordinate"));
    EXPECT_THAT(error_of({{{bad, 0}, {1, 1}}}), HasSubstr("wall 0: has a coordinate"));
  }
}

TEST(VectorMap, MaterialsHaveNames) {
  for (const Material m : {Material::kOpaque, Material::kGlass, Material::kMesh, Material::kMirror}) {
    EXPECT_EQ(material_named(name_of(m)), m);
    EXPECT_TRUE(kAllMaterials.contains(m));
  }
  EXPECT_THROW(material_named("wood"), InputError);
  EXPECT_TRUE(kSeenByLaser.contains(Material::kOpaque));
  EXPECT_FALSE(kSeenByLaser.contains(Material::kGlass));
}

TEST(VectorMap, DistanceToAWall) {
  const Wall wall{{0, 0}, {4, 0}};
  EXPECT_DOUBLE_EQ(distance({2, 3}, wall), 3.0);
  EXPECT_DOUBLE_EQ(distance({7, 4}, wall), 5.0);
  EXPECT_DOUBLE_EQ(distance({-3, -4}, wall), 5.0);
  EXPECT_DOUBLE_EQ(distance({1, 0}, wall), 0.0);
}

}  // namespace
}  // namespace cairn
