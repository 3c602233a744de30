#include "cairn/io/pgm.hpp"

#include "bad_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

GrayImage read(std::istream& input) { return read_pgm(read_rest(input), "f"); }
std::string error_of(const std::string& bytes) { return test::error_on(read, bytes); }

TEST(Pgm, ReadsPlainWithCommentsAndCrlf) {
  const GrayImage image = read_pgm("P2 # made by hand\r\n# two\n3 2\r\n10\n0 5 10\n10 5 0", "f");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.gray, ElementsAre(0, 128, 255, 255, 128, 0));
  EXPECT_TRUE(image.opacity.empty());
}

TEST(Pgm, ReadsRawOfOneAndTwoBytes) {
  EXPECT_THAT(read_pgm(std::string("P5\n2 1\n255\n\x0a\xff", 13), "f").gray, ElementsAre(10, 255));
  EXPECT_THAT(read_pgm(std::string("P5 2 1 65535\n\x80\x00\xff\xff", 17), "f").gray, ElementsAre(128, 255));
  EXPECT_THAT(read_pgm(std::string("P5 2 1 511\n\x00\xff\x01\xff", 15), "f").gray, ElementsAre(127, 255));
}

TEST(Pgm, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of("P6\n1 1\n255\nabc"), HasSubstr("P2 or P5"));
  EXPECT_THAT(error_of("P5\nwide 1\n255\nabc"), HasSubstr("f (byte 3): no number where the width"));
  EXPECT_THAT(error_of("P5\n-3 1\n255\nabc"), HasSubstr("width is not within"));
  EXPECT_THAT(error_of("P5\n0 1\n255\nabc"), HasSubstr("width is not within"));
  EXPECT_THAT(error_of("P5\n99999999999999999999 1\n255\n"), HasSubstr("width is not within"));
  EXPECT_THAT(error_of("P5\n1000000000 1000000000\n255\nabc"),
              HasSubstr("announces 1000000000 x 1000000000"));
  EXPECT_THAT(error_of("P2\n100000 100000\n255\n1 2 3"), HasSubstr("announces"));
  EXPECT_THAT(error_of("P5\n1 1\n65536\nab"), HasSubstr("maximum value is not within 1..65535"));
  EXPECT_THAT(error_of("P5\n1 1\n0\na"), HasSubstr("maximum value"));
  EXPECT_THAT(error_of("P2\n2 1\n10\n3 11\n"), HasSubstr("pixel is not within 0..10"));
  EXPECT_THAT(error_of("P5\n1 1\n100\n\xff"), HasSubstr("exceeds the maximum value 100"));
  EXPECT_THAT(error_of("P5\n2 1\n255\nabc"), HasSubstr("more follows"));
}

TEST(Pgm, AcceptsNoCutButThatOfTheLastWhiteSpace) {
  EXPECT_EQ(test::accepted_cuts(read, "P5\n2 2\n255\nabcd\n"), 1u);
  EXPECT_EQ(test::accepted_cuts(read, "P2\n2 2\n255\n1 2 3 4\n"), 1u);
}

TEST(Pgm, IsReadBackTheSame) {
  const GrayImage image{3, 2, {0, 1, 2, 253, 254, 255}, {}};
  std::ostringstream output;
  write_pgm(output, image);
  EXPECT_EQ(read_pgm(output.str(), "f"), image);
}

}  // namespace
}  // namespace cairn
