#include "cairn/io/vector_text.hpp"

#include "bad_input.hpp"
#include "cairn/io/input_file.hpp"
#include "test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

VectorMap read(std::istream& input) {
  Diagnostics diagnostics;
  return read_vector_text(input, "f", diagnostics);
}
std::string error_of(const std::string& text) { return test::error_on(read, text); }

TEST(VectorText, ReadsOneWallPerLine) {
  std::istringstream input("# a comment\n1,2,3.5,-4\r\n\n 1 2 3 4 \n5,6,5,6\n");
  Diagnostics diagnostics;
  const VectorMap map = read_vector_text(input, "f", diagnostics);
  EXPECT_EQ(map.walls(), (std::vector<Wall>{{{1, 2}, {3.5, -4}}, {{1, 2}, {3, 4}}}));
  EXPECT_EQ(diagnostics.counts().at("zero-length segment"), 1);
}

TEST(VectorText, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of(""), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of("\n# nothing\n"), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of("1,1,1,1\n"), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of("0,0,1,0\n1,2,wall,4\n"), HasSubstr("f:2:5: 'wall'"));
  EXPECT_THAT(error_of("0,0,1,0\n1,2,nan,4\n"), HasSubstr("f:2:5"));
  EXPECT_THAT(error_of("0,0,1,inf\n"), HasSubstr("f:1:7"));
  EXPECT_THAT(error_of("0,0,1\n"), HasSubstr("f:1"));
  EXPECT_THAT(error_of("0,0,,1\n"), HasSubstr("f:1"));
  EXPECT_THAT(error_of("0,0,1,1,1\n"), HasSubstr("f:1:9"));
  EXPECT_THAT(error_of("0,0,1,2e7\n"), HasSubstr("f:1: the coordinate"));
  EXPECT_THAT(error_of("0,0,1,1e999\n"), HasSubstr("f:1:7"));
}

TEST(VectorText, AcceptsOnlyCutsAtTheEndOfANumber) {
  const std::string text = "0,0,10,0\n10,0,10,25\n";
  // After line 1 without and with its end; within and after the last number of line 2.
  EXPECT_EQ(test::accepted_cuts(read, text), 4u);
}

TEST(VectorText, KnowsItsOwnKind) {
  EXPECT_TRUE(looks_like_vector_text("9.0241,34.5064,8.7663,31.4124\n19.9338,49.4"));
  EXPECT_TRUE(looks_like_vector_text("# walls\n1 2 3 4\n"));
  EXPECT_FALSE(looks_like_vector_text("image: map.png\nresolution: 0.05\n"));
  EXPECT_FALSE(looks_like_vector_text("global_map[0]: 3 2"));
  EXPECT_FALSE(looks_like_vector_text("1 2 3\n"));
  EXPECT_FALSE(looks_like_vector_text("{\"type\": 1}"));
  EXPECT_FALSE(looks_like_vector_text(""));
}

TEST(VectorText, RealBuildings) {
  const struct {
    const char* file;
    std::size_t walls;
    std::int64_t zero_length;
  } maps[] = {{"GHC7", 2788, 6}, {"NSH4", 8930, 474}, {"CVAP7", 230, 0}};
  for (const auto& expected : maps) {
    const std::string relative = std::string("vector_maps/") + expected.file + "_vector.txt";
    CAIRN_SKIP_WITHOUT(relative);
    Diagnostics diagnostics;
    const auto path = test::data_file(relative);
    const VectorMap map = read_vector_text(*open_input(path), path.string(), diagnostics);
    const auto counts = diagnostics.counts();
    const std::int64_t left_out = counts.empty() ? 0 : counts.at("zero-length segment");
    EXPECT_EQ(map.walls().size() + static_cast<std::size_t>(left_out), expected.walls) << expected.file;
    EXPECT_EQ(left_out, expected.zero_length) << expected.file;
  }
}

}  // namespace
}  // namespace cairn
