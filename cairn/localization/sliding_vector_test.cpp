#include "cairn/localization/sliding_vector.hpp"

#include <deque>
#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(SlidingVector, DoesAsADequeDoes) {
  SlidingVector<int> sliding;
  std::deque<int> deque;
  unsigned dice = 1;
  for (int i = 0; i < 5000; ++i) {
    dice = dice * 1664525U + 1013904223U;
    const unsigned what = (dice >> 16) % 5;
    const std::size_t place = deque.empty() ? 0 : (dice >> 20) % deque.size();
    if (what <= 1) {
      sliding.push_back(i);
      deque.push_back(i);
    } else if (what == 2) {
      sliding.insert(place, i);
      deque.insert(deque.begin() + static_cast<std::ptrdiff_t>(place), i);
    } else if (what == 3 && !deque.empty()) {
      sliding.drop_front(1);
      deque.pop_front();
    } else if (!deque.empty()) {
      sliding.erase(place);
      deque.erase(deque.begin() + static_cast<std::ptrdiff_t>(place));
    }
    ASSERT_TRUE(std::equal(sliding.begin(), sliding.end(), deque.begin(), deque.end())) << i;
    ASSERT_EQ(sliding.size(), deque.size());
  }
}

TEST(SlidingVector, ReleasesWhatIsDropped) {
  SlidingVector<std::shared_ptr<int>> sliding;
  const auto item = std::make_shared<int>(1);
  sliding.push_back(item);
  sliding.push_back(item);
  sliding.drop_front(1);
  EXPECT_EQ(item.use_count(), 2);
}

TEST(SlidingVector, StopsGrowingInTheSteadyState) {
  SlidingVector<int> sliding;
  for (int i = 0; i < 100; ++i) sliding.push_back(i);
  std::size_t moves = 0;
  const int* place = &sliding.back();
  for (int i = 0; i < 100000; ++i) {
    sliding.drop_front(1);
    sliding.push_back(i);
    if (&sliding.back() < place) ++moves;
    place = &sliding.back();
  }
  EXPECT_LT(moves, 3000U) << "it moves down only now and then";
  EXPECT_EQ(sliding.size(), 100U);
}

TEST(SlidingVector, RetainsWhatIsWanted) {
  SlidingVector<int> sliding;
  for (int i = 0; i < 10; ++i) sliding.push_back(i);
  sliding.drop_front(2);
  sliding.retain([](int i) { return i % 3 != 0; });
  const std::vector<int> expected{2, 4, 5, 7, 8};
  EXPECT_TRUE(std::equal(sliding.begin(), sliding.end(), expected.begin(), expected.end()));
}

}  // namespace
}  // namespace cairn
