#include "cairn/io/map_yaml.hpp"

#include "bad_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Mode = MapDescription::Mode;

const std::string kRequired = "image: a.png\nresolution: 0.05\norigin: [-8, 4.5, 0.5]\n";
constexpr int kUnknown = OccupancyGrid::kUnknown;

MapDescription describe(std::istream& input) {
  Diagnostics diagnostics;
  return read_map_description(input, "f", diagnostics);
}
MapDescription describe_text(const std::string& text) {
  std::istringstream input(text);
  return describe(input);
}
std::string error_of(const std::string& text) { return test::error_on(describe, text); }

TEST(MapDescription, HasTheDefaultsOfNav2) {
  const MapDescription map = describe_text(kRequired);
  EXPECT_EQ(map.image, "a.png");
  EXPECT_EQ(map.resolution_m, 0.05);
  EXPECT_EQ(map.T_map_grid, (Pose2{-8, 4.5, 0.5}));
  EXPECT_FALSE(map.negate);
  EXPECT_EQ(map.thresholds.occupied, 0.65);
  EXPECT_EQ(map.thresholds.free, 0.25);
  EXPECT_EQ(map.mode, Mode::kTrinary);
}

TEST(MapDescription, ReadsEveryKey) {
  const MapDescription map =
      describe_text(kRequired + "negate: 1\r\noccupied_thresh: 0.7\r\nfree_thresh: 0.196\r\nmode: scale\r\n");
  EXPECT_TRUE(map.negate);
  EXPECT_EQ(map.thresholds.occupied, 0.7);
  EXPECT_EQ(map.thresholds.free, 0.196);
  EXPECT_EQ(map.mode, Mode::kScale);
  EXPECT_TRUE(describe_text(kRequired + "negate: true\n").negate);
  EXPECT_EQ(describe_text(kRequired + "mode: raw\n").mode, Mode::kRaw);
}

TEST(MapDescription, CountsUnknownKeys) {
  std::istringstream input(kRequired + "resolutoin: 3\n");
  Diagnostics diagnostics;
  read_map_description(input, "f", diagnostics);
  EXPECT_EQ(diagnostics.counts().at("unknown key"), 1);
  EXPECT_THAT(diagnostics.examples().at(0).text, HasSubstr("f:4:1: 'resolutoin'"));
}

TEST(MapDescription, WarnsOfAResolutionInCentimetres) {
  Diagnostics diagnostics;
  std::istringstream input("image: a.pgm\nresolution: 5.0\norigin: [0, 0, 0]\n");
  EXPECT_EQ(read_map_description(input, "m.yaml", diagnostics).resolution_m, 5.0);
  EXPECT_EQ(diagnostics.counts().at("implausible units"), 1);
}

TEST(MapDescription, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of(""), HasSubstr("is not a map description"));
  EXPECT_THAT(error_of("- 1\n- 2\n"), HasSubstr("is not a map description"));
  EXPECT_THAT(error_of("a: [1, 2\n"), HasSubstr("is not YAML"));
  EXPECT_THAT(error_of("resolution: 0.05\norigin: [0, 0, 0]\n"), HasSubstr("has no key 'image'"));
  EXPECT_THAT(error_of("image: a.png\norigin: [0, 0, 0]\n"), HasSubstr("has no key 'resolution'"));
  EXPECT_THAT(error_of("image: a.png\nresolution: 0.05\n"), HasSubstr("has no key 'origin'"));
  const auto with_resolution = [](const std::string& value) {
    return error_of("image: a.png\norigin: [0, 0, 0]\nresolution: " + value + "\n");
  };
  for (const char* value : {"0", "-0.05", ".nan", ".inf", "1000", "1e-9"}) {
    EXPECT_THAT(with_resolution(value), HasSubstr("f:3:13: resolution is not within")) << value;
  }
  EXPECT_THAT(with_resolution("fine"), HasSubstr("resolution is not a number"));
  EXPECT_THAT(with_resolution("[1]"), HasSubstr("resolution is not a number"));
  EXPECT_THAT(error_of("image: a\nresolution: 1\norigin: [0, 0]\n"), HasSubstr("origin is not [x, y, yaw]"));
  EXPECT_THAT(error_of("image: a\nresolution: 1\norigin: [0, .nan, 0]\n"),
              HasSubstr("origin y is not within"));
  EXPECT_THAT(error_of("image: a\nresolution: 1\norigin: 3\n"), HasSubstr("origin is not [x, y, yaw]"));
  EXPECT_THAT(error_of("image: {}\nresolution: 1\norigin: [0, 0, 0]\n"), HasSubstr("image is not a word"));
  EXPECT_THAT(error_of(kRequired + "negate: 2\n"), HasSubstr("negate"));
  EXPECT_THAT(error_of(kRequired + "mode: fuzzy\n"), HasSubstr("use trinary, scale or raw"));
  EXPECT_THAT(error_of(kRequired + "occupied_thresh: 65\n"), HasSubstr("occupied_thresh is not within 0..1"));
  EXPECT_THAT(error_of(kRequired + "occupied_thresh: 0.1\n"), HasSubstr("free_thresh exceeds"));
}

TEST(MapDescription, NoCutCrashes) {
  EXPECT_GT(test::accepted_cuts(describe, kRequired + "negate: 1\nmode: scale\nfree_thresh: 0.196\n"), 0u);
}

MapDescription description(Mode mode, bool negate = false) {
  MapDescription map;
  map.resolution_m = 0.5;
  map.T_map_grid = {-1.0, 2.0, 0.0};
  map.mode = mode;
  map.negate = negate;
  return map;
}

TEST(ToGrid, PutsTheTopRowOfThePictureLast) {
  const GrayImage image{2, 2, {0, 254, 254, 128}, {}};  // occupied free / free unknown
  const OccupancyGrid grid = to_grid(image, description(Mode::kTrinary));
  EXPECT_THAT(grid.cells(), ElementsAre(0, kUnknown, 100, 0));
  // The lower left cell's outer corner is the origin.
  EXPECT_EQ(grid.state_at({-0.99, 2.01}), CellState::kFree);
  EXPECT_EQ(grid.state_at({-0.99, 2.99}), CellState::kOccupied);
  EXPECT_EQ(grid.state_at({-1.01, 2.99}), CellState::kUnknown);
  EXPECT_EQ(grid.state_at({-0.01, 2.51}), CellState::kFree);
}

TEST(ToGrid, TrinaryFollowsTheThresholds) {
  // p = 1 - grey / 255: 89 -> 0.651, 90 -> 0.647, 191 -> 0.251, 192 -> 0.247
  const GrayImage image{4, 1, {89, 90, 191, 192}, {}};
  EXPECT_THAT(to_grid(image, description(Mode::kTrinary)).cells(), ElementsAre(100, kUnknown, kUnknown, 0));
  const GrayImage negative{4, 1, {166, 165, 64, 63}, {}};
  EXPECT_THAT(to_grid(negative, description(Mode::kTrinary, true)).cells(),
              ElementsAre(100, kUnknown, kUnknown, 0));
}

TEST(ToGrid, ScaleKeepsTheProbabilityAndTheStates) {
  std::vector<std::uint8_t> grays;
  for (int gray = 0; gray < 256; ++gray) grays.push_back(static_cast<std::uint8_t>(gray));
  const GrayImage image{256, 1, grays, {}};
  const OccupancyGrid scaled = to_grid(image, description(Mode::kScale));
  const OccupancyGrid trinary = to_grid(image, description(Mode::kTrinary));
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_NEAR(scaled.cells()[i], 100 * (1 - double(i) / 255), 1.0);
    EXPECT_EQ(scaled.state(i), trinary.state(i)) << "grey " << i;
  }
}

TEST(ToGrid, RawTakesTheNumbers) {
  const GrayImage image{4, 1, {0, 100, 101, 255}, {}};
  EXPECT_THAT(to_grid(image, description(Mode::kRaw)).cells(), ElementsAre(0, 100, kUnknown, kUnknown));
}

TEST(ToGrid, RefusesMoreCellsThanAMapMayHave) {
  const GrayImage image{65536, 65536, {}, {}};
  MapDescription map;
  map.image = "huge.pgm";
  map.resolution_m = 0.05;
  EXPECT_THROW(to_grid(image, map), InputError);
}

TEST(ToGrid, ClearPixelsAreUnknown) {
  const GrayImage image{2, 1, {0, 0}, {255, 254}};
  EXPECT_THAT(to_grid(image, description(Mode::kTrinary)).cells(), ElementsAre(100, kUnknown));
  EXPECT_THAT(to_grid(image, description(Mode::kScale)).cells(), ElementsAre(100, kUnknown));
}

}  // namespace
}  // namespace cairn
