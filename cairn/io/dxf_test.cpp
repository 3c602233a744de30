#include "cairn/io/dxf.hpp"

#include "bad_input.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

VectorMap read(std::istream& input) {
  Diagnostics diagnostics;
  return read_dxf(input, "f", {}, diagnostics);
}
VectorMap read(const std::string& text) {
  std::istringstream input(text);
  return read(input);
}
std::string error_of(const std::string& text) {
  return test::error_on([](std::istream& input) { read(input); }, text);
}

std::string line(double x0, double y0, double x1, double y1) {
  std::ostringstream text;
  text << "0\nLINE\n8\n0\n10\n" << x0 << "\n20\n" << y0 << "\n11\n" << x1 << "\n21\n" << y1 << "\n";
  return text.str();
}
std::string insert(const std::string& block, const std::string& more = "") {
  return "0\nINSERT\n2\n" + block + "\n10\n0\n20\n0\n" + more;
}
std::string block(const std::string& name, const std::string& entities) {
  return "0\nBLOCK\n2\n" + name + "\n10\n0\n20\n0\n" + entities + "0\nENDBLK\n";
}
std::string drawing(const std::string& entities, const std::string& blocks = "") {
  return "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

bool near(const Point2& a, const Point2& b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-9; }

// A wall with these ends, in either order.
const Wall* find(const VectorMap& map, const Point2& a, const Point2& b) {
  const auto found = std::find_if(map.walls().begin(), map.walls().end(), [&](const Wall& w) {
    return (near(w.a, a) && near(w.b, b)) || (near(w.a, b) && near(w.b, a));
  });
  return found == map.walls().end() ? nullptr : &*found;
}

// Every wall with an end within `reach` of the centre has both on the circle. Returns their length.
double length_on_circle(const VectorMap& map, const Point2& center, double radius, double reach) {
  double length = 0.0;
  for (const Wall& w : map.walls()) {
    const double a = std::hypot(w.a.x - center.x, w.a.y - center.y);
    const double b = std::hypot(w.b.x - center.x, w.b.y - center.y);
    if (a > reach || b > reach) continue;
    EXPECT_NEAR(a, radius, 1e-9);
    EXPECT_NEAR(b, radius, 1e-9);
    const Point2 middle{(w.a.x + w.b.x) / 2, (w.a.y + w.b.y) / 2};
    EXPECT_GT(std::hypot(middle.x - center.x, middle.y - center.y), radius - 0.005) << "chord tolerance";
    length += std::hypot(w.a.x - w.b.x, w.a.y - w.b.y);
  }
  return length;
}

// Two drawings of the same, in millimetres, made with ezdxf (tests/data/dxf/make_drawings.py).
class DxfDrawings : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::ifstream file(std::string(CAIRN_SOURCE_DIR) + "/tests/data/dxf/" + GetParam());
    ASSERT_TRUE(file.good());
    DxfOptions options;
    if (std::string(GetParam()) == "r12.dxf") options.unit_m = 0.001;  // R12 cannot tell its unit
    map_ = std::make_unique<VectorMap>(read_dxf(file, "f", options, diagnostics_));
  }
  Diagnostics diagnostics_;
  std::unique_ptr<VectorMap> map_;
};

TEST_P(DxfDrawings, LinesAndPolylinesWithTheMaterialOfTheirLayer) {
  ASSERT_NE(find(*map_, {0, 0}, {4, 0}), nullptr);
  EXPECT_EQ(find(*map_, {0, 0}, {4, 0})->material, Material::kOpaque);
  ASSERT_NE(find(*map_, {4, 0}, {4, 3}), nullptr);
  EXPECT_EQ(find(*map_, {4, 0}, {4, 3})->material, Material::kGlass);
  EXPECT_NE(find(*map_, {0, 0}, {0, 3}), nullptr);
  EXPECT_NE(find(*map_, {0, 3}, {4, 3}), nullptr);
}

TEST_P(DxfDrawings, BulgesCirclesAndArcs) {
  // The bulge 1 is half a circle, counter-clockwise from (1, 1) to (2, 1): below.
  EXPECT_NEAR(length_on_circle(*map_, {1.5, 1.0}, 0.5, 0.6), kPi * 0.5, 0.02);
  EXPECT_NE(
      std::find_if(map_->walls().begin(), map_->walls().end(),
                   [](const Wall& w) { return w.a.y < 0.6 && std::abs(w.a.x - 1.5) < 0.3 && w.a.y > 0.45; }),
      map_->walls().end());
  EXPECT_NEAR(length_on_circle(*map_, {3.0, 2.0}, 0.25, 0.3), kTwoPi * 0.25, 0.03);
  EXPECT_NEAR(length_on_circle(*map_, {10.0, 0.0}, 1.0, 1.1), kPi / 2, 0.01);
}

// LEAF runs 1 m along x from its base point; DOOR turns it left at (0, 0.5) and has half a metre of its own.
TEST_P(DxfDrawings, NestedBlocksAreScaledTurnedAndMirrored) {
  const double c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  const auto placed = [&](double x, double y) {  // twice as wide, upside down, turned by 30 degrees
    return Point2{20.0 + c * 2 * x + s * y, s * 2 * x - c * y};
  };
  const Wall* const leaf = find(*map_, placed(0, 0.5), placed(0, 1.5));
  ASSERT_NE(leaf, nullptr);
  EXPECT_EQ(leaf->material, Material::kGlass) << "layer 0 twice: that of the outer insertion";
  const Wall* const frame = find(*map_, placed(0, 0), placed(0, 0.5));
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->material, Material::kOpaque);
}

TEST_P(DxfDrawings, InsertionsInRowsAndColumns) {
  // 3 columns, 2 m apart, and 2 rows, 5 m apart, turned left: columns go up, rows to the left.
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 2; ++row) {
      const Point2 at{30.0 - 5.0 * row, 2.0 * column};
      EXPECT_NE(find(*map_, at, {at.x, at.y + 1.0}), nullptr) << column << ' ' << row;
    }
  }
}

TEST_P(DxfDrawings, CountsWhatItLeavesOut) {
  EXPECT_EQ(diagnostics_.counts().at("paper space"), 1);
  EXPECT_EQ(diagnostics_.counts().at("entity without walls: TEXT"), 1);
  for (const Wall& w : map_->walls()) EXPECT_FALSE(near(w.a, {0, 0}) && near(w.b, {0.001, 0.001}));
}

INSTANTIATE_TEST_SUITE_P(Ezdxf, DxfDrawings, ::testing::Values("r12.dxf", "r2010.dxf"),
                         [](const auto& chosen) { return chosen.index == 0 ? "R12" : "R2010"; });

TEST(Dxf, UnitsAndLayersAreTold) {
  const std::string header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1\n0\nENDSEC\n";
  EXPECT_DOUBLE_EQ(read(header + drawing(line(0, 0, 100, 0))).length_m(), 2.54);
  EXPECT_DOUBLE_EQ(read(drawing(line(0, 0, 100, 0))).length_m(), 100.0);
  std::istringstream input(header + drawing(line(0, 0, 100, 0)));
  Diagnostics diagnostics;
  const VectorMap map =
      read_dxf(input, "f", {.layers = {{"0", Material::kMirror}}, .unit_m = 0.5, .chord_tolerance_m = 0.01},
               diagnostics);
  EXPECT_DOUBLE_EQ(map.length_m(), 50.0);
  EXPECT_EQ(map.count(Material::kMirror), 1u);
  EXPECT_TRUE(diagnostics.empty());
}

TEST(Dxf, AMirroredEntityIsSeenFromBelow) {
  const VectorMap map = read(drawing("0\nARC\n8\n0\n10\n5\n20\n0\n40\n1\n50\n0\n51\n90\n230\n-1\n"));
  for (const Wall& w : map.walls()) {  // from (-6, 0) to (-5, 1)
    EXPECT_LE(w.a.x, -5.0 + 1e-9);
    EXPECT_GE(w.a.y, -1e-9);
  }
}

TEST(Dxf, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_of(""), HasSubstr("the file ends before EOF"));
  EXPECT_THAT(error_of("wall\n1\n"), HasSubstr("f:1: is no group code"));
  EXPECT_THAT(error_of("AutoCAD Binary DXF\r\n"), HasSubstr("f: is a binary DXF file"));
  EXPECT_THAT(error_of(drawing("")), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of(drawing(line(0, 0, 0, 0))), HasSubstr("f: holds no wall"));
  EXPECT_THAT(error_of(drawing("0\nLINE\n10\nnan\n")), HasSubstr("f:14: 'nan' is no finite number"));
  EXPECT_THAT(error_of(drawing("0\nLINE\n10\n1e999\n")), HasSubstr("is no finite number"));
  EXPECT_THAT(error_of(drawing("0\nLINE\n10\nx\n")), HasSubstr("'x' is no finite number"));
  EXPECT_THAT(error_of(drawing(line(0, 0, 1e8, 0))), HasSubstr("the coordinate is not finite or beyond"));
  EXPECT_THAT(error_of(drawing(insert("NONE"))), HasSubstr("inserts the block 'NONE'"));
  EXPECT_THAT(error_of(drawing("0\nCIRCLE\n10\n0\n20\n0\n40\n1e9\n")), HasSubstr("radius beyond"));
  EXPECT_THAT(error_of(drawing("0\nLWPOLYLINE\n10\n0\n20\n0\n42\n1e300\n10\n1\n20\n0\n")),
              HasSubstr("radius beyond"));
}

TEST(Dxf, RefusesBlocksWithoutEnd) {
  EXPECT_THAT(error_of(drawing(insert("A"), block("A", insert("A")))), HasSubstr("nested more than 16 deep"));
  EXPECT_THAT(error_of(drawing(insert("A"), block("A", insert("B")) + block("B", insert("A")))),
              HasSubstr("nested more than 16 deep"));
  // Each of 10 blocks inserts the next one ten times.
  std::string blocks;
  for (int i = 0; i < 10; ++i) blocks += block(std::to_string(i), insert(std::to_string(i + 1), "70\n10\n"));
  EXPECT_THAT(error_of(drawing(insert("0"), blocks + block("10", line(0, 0, 1, 0)))),
              HasSubstr("more than a million"));
}

TEST(Dxf, RefusesHugeArrays) {
  for (const std::string& content : {std::string(), line(0, 0, 1, 0)}) {
    for (const char* size : {"70\n1000000000\n", "70\n40000\n71\n40000\n",
                             "70\n9223372036854775807\n71\n9223372036854775807\n"}) {
      EXPECT_THAT(error_of(drawing(insert("A", size), block("A", content))), HasSubstr("more than a million"))
          << size;
    }
  }
  EXPECT_THAT(error_of(drawing(insert("A", "70\n99999999999999999999\n"), block("A", ""))),
              HasSubstr("is no integer"));
}

TEST(Dxf, AcceptsNoCutBeforeEof) {
  const std::string text =
      drawing(insert("A", "70\n2\n44\n3\n") + line(0, 0, 1, 1), block("A", line(0, 0, 1, 0)));
  EXPECT_EQ(test::accepted_cuts([](std::istream& input) { read(input); }, text),
            1u);  // without the last line end
}

TEST(Dxf, KnowsItsOwnKind) {
  EXPECT_TRUE(looks_like_dxf("  0\r\nSECTION\r\n  2\r\nHEADER"));
  EXPECT_TRUE(looks_like_dxf("999\nmade by hand\n0\nSECTION\n"));
  EXPECT_TRUE(looks_like_dxf("AutoCAD Binary DXF\r\n\x1a"));
  EXPECT_FALSE(looks_like_dxf("0,0,1,1\n"));
  EXPECT_FALSE(looks_like_dxf(""));
}

}  // namespace
}  // namespace cairn
