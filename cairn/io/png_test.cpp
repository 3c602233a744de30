#include "cairn/io/png.hpp"

#include "bad_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string unhex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

// Pictures of 2 x 1 pixels, written by a few lines of Python (zlib); the last two announce more than they
// hold.
const std::string kGray8 = unhex(
    "89504e470d0a1a0a0000000d4948445200000002000000010800000000d14920560000000b4944415478da63e03a0100"
    "00df00d3d885d2ae0000000049454e44ae426082");
const std::string kGray1 = unhex(
    "89504e470d0a1a0a0000000d4948445200000002000000010100000000dc5942270000000a4944415478da6370000000"
    "42004184bf8e620000000049454e44ae426082");
const std::string kGray16 = unhex(
    "89504e470d0a1a0a0000000d494844520000000200000001100000000081d9fc150000000d4944415478da636860f8ff"
    "1f000502027fc900d6750000000049454e44ae426082");
const std::string kGrayAlpha = unhex(
    "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb7010000000d4944415478da63e0fa7f82"
    "010004ba01d27e4f4db80000000049454e44ae426082");
const std::string kRgb = unhex(
    "89504e470d0a1a0a0000000d49484452000000020000000108020000007b40e8dd0000000f4944415478da63e01291fb"
    "ffff3f000719033a94d8781c0000000049454e44ae426082");
const std::string kRgba = unhex(
    "89504e470d0a1a0a0000000d4948445200000002000000010806000000f4227f8a000000114944415478da63e01291fb"
    "cfc8c4dc0000072401c290ef22c10000000049454e44ae426082");
const std::string kPalette = unhex(
    "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c54450a141e5a5a5a8b"
    "9b2d150000000b4944415478da63606400000005000242c2449f0000000049454e44ae426082");
const std::string kInterlaced = unhex(
    "89504e470d0a1a0a0000000d4948445200000002000000010800000001a64e10c00000000c4944415478da63e0623801"
    "0000ea00d3fc5dd6ec0000000049454e44ae426082");
const std::string kHuge = unhex(
    "89504e470d0a1a0a0000000d49484452200000002000000008000000002f6fea980000000b4944415478da63e03a0100"
    "00df00d3d885d2ae0000000049454e44ae426082");
const std::string kWide = unhex(
    "89504e470d0a1a0a0000000d4948445200007530000075300800000000434ca7660000000b4944415478da63e03a0100"
    "00df00d3d885d2ae0000000049454e44ae426082");

GrayImage read(std::istream& input) { return read_png(read_rest(input), "f"); }

TEST(Png, ReadsEveryKind) {
  EXPECT_THAT(read_png(kGray8, "f").gray, ElementsAre(10, 200));
  EXPECT_THAT(read_png(kGray1, "f").gray, ElementsAre(0, 255));
  EXPECT_THAT(read_png(kGray16, "f").gray, ElementsAre(128, 255));
  EXPECT_THAT(read_png(kGrayAlpha, "f").gray, ElementsAre(10, 200));
  EXPECT_THAT(read_png(kRgb, "f").gray, ElementsAre(20, 255));
  EXPECT_THAT(read_png(kRgba, "f").gray, ElementsAre(20, 2));
  EXPECT_THAT(read_png(kPalette, "f").gray, ElementsAre(90, 20));
  EXPECT_THAT(read_png(kInterlaced, "f").gray, ElementsAre(10, 200));
}

TEST(Png, KeepsOpacityWhereThereIsSome) {
  EXPECT_TRUE(read_png(kGray8, "f").opacity.empty());
  EXPECT_THAT(read_png(kGrayAlpha, "f").opacity, ElementsAre(255, 0));
  EXPECT_THAT(read_png(kRgba, "f").opacity, ElementsAre(255, 128));
}

TEST(Png, RefusesSizesThatTheFileCannotHold) {
  EXPECT_THAT(test::error_on(read, kHuge), HasSubstr("more than it can hold"));
  EXPECT_THAT(test::error_on(read, kWide), HasSubstr("more than it can hold"));
}

TEST(Png, AcceptsNoCutAndNoChangedByteOfTheHeader) {
  EXPECT_EQ(test::accepted_cuts(read, kRgb), 0u);
  for (std::size_t i = 0; i < 33; ++i) {
    std::string changed = kRgb;
    changed[i] = static_cast<char>(changed[i] ^ 0x55);
    EXPECT_FALSE(test::is_accepted(read, changed)) << "byte " << i;
  }
}

TEST(Png, IsReadBackTheSame) {
  const GrayImage image{3, 2, {0, 1, 2, 253, 254, 255}, {}};
  std::ostringstream output;
  write_png(output, image);
  EXPECT_EQ(read_png(output.str(), "f"), image);
}

TEST(Png, WithoutPixelsCannotBeWritten) {
  std::ostringstream output;
  EXPECT_THROW(write_png(output, {}), InputError);
}

}  // namespace
}  // namespace cairn
