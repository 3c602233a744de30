#include "cairn/maps/map_set.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_field.hpp"
#include "mini_maps.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::shared_ptr<const OccupancyGrid> a_grid() {
  return std::make_shared<const OccupancyGrid>(test::draw_grid({"#  ", "   "}));
}

std::shared_ptr<const DistanceField> field_of(const MapSet& maps, double max_distance_m, int& made) {
  return maps.derive<DistanceField>(std::to_string(max_distance_m), [&] {
    ++made;
    return std::make_shared<const DistanceField>(*maps.grid(), max_distance_m);
  });
}

TEST(MapSet, DerivesEachMapOnce) {
  const MapSet maps(a_grid());
  int made = 0;
  const auto first = field_of(maps, 2.0, made);
  EXPECT_EQ(field_of(maps, 2.0, made), first);
  EXPECT_EQ(made, 1);
  EXPECT_NE(field_of(maps, 1.0, made), first);
  EXPECT_EQ(made, 2);
}

TEST(MapSet, KeepsNoDerivedMapThatNobodyHolds) {
  const MapSet maps(a_grid());
  int made = 0;
  const std::weak_ptr<const DistanceField> gone = field_of(maps, 2.0, made);
  EXPECT_TRUE(gone.expired());
  field_of(maps, 2.0, made);
  EXPECT_EQ(made, 2);
}

TEST(MapSet, AGivenMapIsNotADerivedOne) {
  const MapSet maps(a_grid());
  int made = 0;
  field_of(maps, 2.0, made);
  EXPECT_EQ(maps.find<DistanceField>(), nullptr);
  EXPECT_NE(maps.find<OccupancyGrid>(), nullptr);
}

TEST(MapSet, WithoutGridIsAnErrorThatSaysSo) { EXPECT_THROW(MapSet().grid(), ConfigurationError); }

TEST(MapLibrary, FindsMapsByName) {
  MapLibrary library(a_grid());
  const auto upper = std::make_shared<const MapSet>(a_grid());
  library.add("upper", upper);
  EXPECT_EQ(&library.at("upper"), upper.get());
  EXPECT_EQ(&library.at(""), &library.main());
  EXPECT_THROW(library.at("cellar"), ConfigurationError);
}

}  // namespace
}  // namespace cairn
