#include "cairn/io/geojson.hpp"

#include "bad_input.hpp"
#include "random_walls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

VectorMap read(std::istream& input) {
  Diagnostics diagnostics;
  return read_geojson(input, "f", diagnostics);
}
VectorMap read(const std::string& text) {
  std::istringstream input(text);
  return read(input);
}
std::string error_of(const std::string& text) {
  return test::error_on([](std::istream& input) { read(input); }, text);
}
std::string text_of(const VectorMap& map) {
  std::ostringstream output;
  write_geojson(output, map);
  return output.str();
}

TEST(GeoJson, ReadsEveryGeometryThatHasWalls) {
  const VectorMap map = read(R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"material": "glass"},
     "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0, 7.5], [1, 2]]}},
    {"type": "Feature", "properties": null,
     "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [3, 0], [0, 3], [0, 0]]]}},
    {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
       {"type": "MultiPolygon", "coordinates": [[[[5, 5], [6, 5]]]]},
       {"type": "MultiLineString", "coordinates": [[[7, 7], [8, 8]], [[9, 9], [9, 10]]]},
       {"type": "Point", "coordinates": [1, 1]}]}}]})");
  const std::vector<Wall> expected = {{{0, 0}, {1, 0}, Material::kGlass},
                                      {{1, 0}, {1, 2}, Material::kGlass},
                                      {{0, 0}, {3, 0}},
                                      {{3, 0}, {0, 3}},
                                      {{0, 3}, {0, 0}},
                                      {{5, 5}, {6, 5}},
                                      {{7, 7}, {8, 8}},
                                      {{9, 9}, {9, 10}}};
  EXPECT_EQ(map.walls(), expected);
  EXPECT_EQ(read(R"({"type": "LineString", "coordinates": [[0, 0], [1, 0]]})").walls().size(), 1u);
}

TEST(GeoJson, CountsWhatItLeavesOut) {
  std::istringstream input(R"({"type": "GeometryCollection", "geometries": [
    {"type": "LineString", "coordinates": [[0, 0], [0, 0], [1, 1]]}, {"type": "Point", "coordinates": [1, 1]}]})");
  Diagnostics diagnostics;
  EXPECT_EQ(read_geojson(input, "f", diagnostics).walls().size(), 1u);
  EXPECT_EQ(diagnostics.counts().at("zero-length segment"), 1);
  EXPECT_EQ(diagnostics.counts().at("Point"), 1);
}

TEST(GeoJson, WhatIsWrittenReadsBackEqual) {
  for (const VectorMap& map :
       {test::random_walls(300, 50.0, 5.0, 1), VectorMap(std::vector<Wall>{{{1e-300, 1e7}, {0.1, -1e-7}}})}) {
    EXPECT_EQ(read(text_of(map)).walls(), map.walls());
  }
}

TEST(GeoJson, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of(""), HasSubstr("f:1:1: is not JSON here"));
  EXPECT_THAT(error_of("{\"type\":\n  \"LineString\", !}"), HasSubstr("f:2:17: is not JSON here"));
  EXPECT_THAT(error_of("{}"), HasSubstr("f (document): has no 'type'"));
  EXPECT_THAT(error_of("[1]"), HasSubstr("has no 'type'"));
  EXPECT_THAT(error_of(R"({"type": 3})"), HasSubstr("'type' is no word"));
  EXPECT_THAT(error_of(R"({"type": "Circle"})"), HasSubstr("'Circle' is no type"));
  EXPECT_THAT(error_of(R"({"type": "FeatureCollection", "features": 3})"),
              HasSubstr("'features' is no list"));
  EXPECT_THAT(error_of(R"({"type": "FeatureCollection", "features": []})"), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of(R"({"type": "FeatureCollection", "features": [{"type": "Feature"}]})"),
              HasSubstr("f (features[0]): has no 'geometry'"));
  EXPECT_THAT(error_of(R"({"type": "Feature", "properties": {"material": "wood"},
                           "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0]]}})"),
              HasSubstr("the material 'wood' is not known"));
  const auto line = [](const std::string& points) {
    return R"({"type": "LineString", "coordinates": )" + points + "}";
  };
  EXPECT_THAT(error_of(line("[[0, 0]]")), HasSubstr("fewer than two points"));
  EXPECT_THAT(error_of(line("[[0, 0], [1]]")), HasSubstr("coordinates[1]): is no pair"));
  EXPECT_THAT(error_of(line("[[0, 0], [1, \"x\"]]")), HasSubstr("is no pair of numbers"));
  EXPECT_THAT(error_of(line("[[0, 0], [1, 1e8]]")), HasSubstr("coordinates[1]): the coordinate"));
  EXPECT_THAT(error_of(line("[[0, 0], [1, 1e999]]")), HasSubstr("out of range"));
  EXPECT_THAT(error_of(line("[[0, 0], [1, NaN]]")), HasSubstr("is not JSON here"));
  EXPECT_THAT(error_of(line("7")), HasSubstr("is no list"));
}

TEST(GeoJson, RefusesDeepNesting) {
  std::string deep, brackets(1'000'000, '[');
  for (int i = 0; i < 100'000; ++i) deep += R"({"type": "GeometryCollection", "geometries": [)";
  EXPECT_THAT(error_of(deep), HasSubstr("is not JSON here"));
  for (int i = 0; i < 100'000; ++i) deep += "]}";
  EXPECT_THAT(error_of(deep), HasSubstr("nested more than 8 deep"));
  EXPECT_THAT(error_of(brackets), HasSubstr("is not JSON here"));
}

TEST(GeoJson, AcceptsNoCutButTheLastLineEnd) {
  const std::string text = text_of(test::random_walls(8, 9.0, 2.0, 2));
  EXPECT_EQ(test::accepted_cuts([](std::istream& input) { read(input); }, text), 1u);
}

TEST(GeoJson, KnowsItsOwnKind) {
  EXPECT_TRUE(looks_like_geojson(" \n{\"type\""));
  EXPECT_FALSE(looks_like_geojson("image: {}"));
  EXPECT_FALSE(looks_like_geojson(""));
}

}  // namespace
}  // namespace cairn
