#include "cairn/core/pose_cells.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "simd_paths.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const PoseCells kCells{.cells_per_m = 2.0, .first_x = -16.0, .first_y = 100.0, .side = 32, .headings = 36};

TEST(PoseCells, ByHand) {
  EXPECT_EQ(kCells.cell_of({-8.0, 50.0, 0.0}), 0);
  EXPECT_EQ(kCells.cell_of({-7.6, 50.0, 0.0}), 0);
  EXPECT_EQ(kCells.cell_of({-7.5, 50.0, 0.0}), 36);
  EXPECT_EQ(kCells.cell_of({-8.0, 50.5, 0.2}), 32 * 36 + 1);
  EXPECT_EQ(kCells.cell_of({-8.0, 50.0, -1e-9}), 35);
  EXPECT_EQ(kCells.cell_of({7.999, 65.999, -1e-9}), 32 * 32 * 36 - 1);
  EXPECT_EQ(kCells.cell_of({8.0, 65.999, 0.0}), PoseCells::kNone);
  EXPECT_EQ(kCells.cell_of({0.0, 49.999, 0.0}), PoseCells::kNone);
  EXPECT_EQ(kCells.cell_of({0.0, 60.0, 3.2}), kCells.cell_of({0.0, 60.0, 3.2 - kTwoPi}));
  EXPECT_EQ(kCells.cell_of({0.0, 60.0, -6.28}), (20 * 32 + 16) * 36);
  EXPECT_EQ(kCells.cell_of({0.0, 60.0, 6.28}), (20 * 32 + 16) * 36 + 35);
  EXPECT_EQ(kCells.cell_of({0.0, 60.0, 6.29}), PoseCells::kNone);
}

TEST(MarkCells, EqualsOneByOneOnEveryPath) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Pose2> poses = {{kNaN, 55, 0},
                              {0, kNaN, 0},
                              {0, 55, kNaN},
                              {kInfinity, 55, 0},
                              {-1e300, 55, 0},
                              {0, -kInfinity, 0},
                              {0, 55, 1e9},
                              {-8, 50, -kPi},
                              {0, 55, -kInfinity},
                              {-8 - 1e-13, 50, 0},
                              {0, 55, -1e-300},
                              {0, 55, 6.28},
                              {0, 55, -6.28},
                              {0, 55, 6.2801},
                              {0, 55, 3.2},
                              // a bias of 1.5 * 2^52 makes these 2^52 and 0
                              {-0x1p50 - 8, 55, 0},
                              {-0x1.8p51 - 8, 55, 0},
                              {0, -0x1p50, 0},
                              {0, -0x1.8p51, 0}};
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const auto u = random.uniform4(i);
    poses.push_back({20.0 * u[0] - 10.0, 48.0 + 20.0 * u[1], kTwoPi * u[2] - kPi});
  }
  for (int k = -18; k < 18; ++k)
    poses.push_back({0.5 * k, 60.0 + 0.5 * k, k * (kTwoPi / 36.0)});  // on the bounds
  test::on_every_simd_path([&](SimdPath path) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{13}, poses.size()}) {
      const auto some = std::span<const Pose2>(poses).first(count);
      std::vector<std::uint8_t> marks(32 * 32 * 36, 6), expected_marks = marks;
      std::vector<std::uint32_t> elsewhere(count), expected_elsewhere;
      std::set<std::int32_t> found;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::int32_t cell = kCells.cell_of(some[i]);
        if (cell == PoseCells::kNone) {
          expected_elsewhere.push_back(i);
        } else {
          expected_marks[static_cast<std::size_t>(cell)] = 7;
          found.insert(cell);
        }
      }
      const CellsMarked done = mark_cells(kCells, some, 7, marks, elsewhere);
      elsewhere.resize(done.elsewhere);
      EXPECT_EQ(done.fresh, found.size()) << name_of(path) << ' ' << count;
      EXPECT_EQ(marks, expected_marks) << name_of(path) << ' ' << count;
      EXPECT_EQ(elsewhere, expected_elsewhere) << name_of(path) << ' ' << count;
      EXPECT_TRUE(count < 100 || found.size() > 1000u);
    }
  });
}

}  // namespace
}  // namespace cairn
