#include "cairn/io/no_return_mark.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Readings spread evenly over (0, 30) m, and `marked` more at `mark_m`.
std::vector<std::shared_ptr<LaserScan>> hall(int spread, int marked, double mark_m) {
  auto scan = std::make_shared<LaserScan>();
  for (int i = 0; i < spread; ++i)
    scan->ranges_m.push_back(static_cast<float>(30.0 * (i + 1) / (spread + 1)));
  for (int i = 0; i < marked; ++i) scan->ranges_m.push_back(static_cast<float>(mark_m));
  return {scan};
}

TEST(NoReturnMark, IsTheLargestReadingIfItStandsOut) {
  const auto mark = find_no_return_mark(hall(10000, 500, 51.15), 80.0);
  ASSERT_TRUE(mark);
  EXPECT_NEAR(*mark, 51.15, 1e-5);
}

TEST(NoReturnMark, FarWallsAreNone) {
  EXPECT_FALSE(find_no_return_mark(hall(10000, 0, 0), 80.0));
  EXPECT_FALSE(find_no_return_mark(hall(100000, 50, 51.15), 80.0)) << "too few";
  EXPECT_FALSE(find_no_return_mark(hall(100000, 500, 30.01), 80.0))
      << "barely more than the readings before it";
  EXPECT_FALSE(find_no_return_mark(hall(0, 500, 7.5), 80.0)) << "too near";
}

TEST(NoReturnMark, ValuesBeyondTheLimitAndNotFiniteDoNotCount) {
  EXPECT_FALSE(find_no_return_mark(hall(10000, 500, 81.83), 80.0));
  EXPECT_FALSE(find_no_return_mark(hall(10000, 500, INFINITY), 80.0));
  EXPECT_FALSE(find_no_return_mark(hall(10000, 500, NAN), 80.0));
  EXPECT_FALSE(find_no_return_mark({}, 80.0));
}

}  // namespace
}  // namespace cairn
