#include "cairn/models/search/self_similarity.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr SignatureShape kHalf{};
constexpr SignatureShape kAllAround{.first_bearing_rad = -kPi, .last_bearing_rad = kPi};

std::vector<SelfSimilarPlace> look_at(const OccupancyGrid& map, const SelfSimilarityOptions& options,
                                      int threads = 1, const SignatureShape& shape = kHalf) {
  const PlaceIndex index(map, shape, {.spacing_m = 0.8});
  return find_self_similarity(map, index, {}, 20.0, options, Executor(threads));
}

double ambiguous_share(const std::vector<SelfSimilarPlace>& places) {
  return static_cast<double>(std::count_if(places.begin(), places.end(),
                                           [](const auto& p) { return !p.alternatives.empty(); })) /
         static_cast<double>(places.size());
}

// Who looks away from what tells the places apart does not see it: of all poses, not of the positions.
double ambiguous_share_of_headings(const std::vector<SelfSimilarPlace>& places) {
  double headings = 0.0;
  for (const SelfSimilarPlace& place : places) headings += place.ambiguous_headings;
  return headings / static_cast<double>(places.size());
}

/// Arms of 4 m, 1.6 m wide, 0.1 m cells; `door`: a niche in one arm's side.
OccupancyGrid cross(bool door) {
  constexpr int kSize = 81, kMiddle = 40, kHalfWidth = 8;
  std::vector<std::string> lines(kSize, std::string(kSize, '?'));
  for (int r = 0; r < kSize; ++r) {
    for (int c = 0; c < kSize; ++c) {
      const int x = std::abs(c - kMiddle), y = std::abs(r - kMiddle);
      const bool inside = (x < kHalfWidth && y < kMiddle) || (y < kHalfWidth && x < kMiddle);
      const bool edge = (x <= kHalfWidth && y <= kMiddle) || (y <= kHalfWidth && x <= kMiddle);
      if (edge) lines[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = inside ? ' ' : '#';
    }
  }
  if (door) {
    for (int r = kMiddle - 3; r <= kMiddle + 3; ++r)
      lines[static_cast<std::size_t>(r)].replace(70, 8, "########");
  }
  return test::draw_grid(lines, 0.1);
}

TEST(SelfSimilarity, ACrossIsAmbiguousEverywhereAndStaysSo) {
  const auto places = look_at(cross(false), {.headings = 4});
  EXPECT_GT(ambiguous_share(places), 0.99);
  for (const SelfSimilarPlace& place : places) {
    EXPECT_TRUE(std::isinf(place.resolved_after_m)) << place.T_map_sensor.x << " " << place.T_map_sensor.y;
  }
}

// The best alternative is one of the three turned copies of the place.
TEST(SelfSimilarity, TheAlternativesAreTheTurnedCopies) {
  const auto places = look_at(cross(false), {.headings = 4});
  std::size_t copies = 0;
  for (const SelfSimilarPlace& place : places) {
    ASSERT_FALSE(place.alternatives.empty());
    const Pose2 own = Pose2{-4.05, -4.05, 0.0} * place.T_map_sensor;  // about the middle
    const Pose2 other = Pose2{-4.05, -4.05, 0.0} * place.alternatives[0].T_map_sensor;
    for (int quarter = 1; quarter < 4; ++quarter) {
      const Pose2 copy = Pose2{0.0, 0.0, quarter * kPi / 2.0} * own;
      copies += distance(copy, other) < 0.3 && std::abs(normalize_angle(copy.theta - other.theta)) < 0.2;
    }
  }
  EXPECT_GT(static_cast<double>(copies), 0.9 * static_cast<double>(places.size()));
}

// What one arm holds tells it from the others: at once where it is seen, else after the way to it.
TEST(SelfSimilarity, SomethingInOneArmIsFoundByDriving) {
  const auto places = look_at(cross(true), {.headings = 4});
  std::size_t resolved = 0;
  double longest = 0.0;
  for (const SelfSimilarPlace& place : places) {
    if (place.alternatives.empty()) continue;
    resolved += std::isfinite(place.resolved_after_m);
    if (std::isfinite(place.resolved_after_m)) longest = std::max(longest, place.resolved_after_m);
  }
  EXPECT_LT(ambiguous_share_of_headings(places),
            ambiguous_share_of_headings(look_at(cross(false), {.headings = 4})) - 0.1);
  EXPECT_GT(static_cast<double>(resolved),
            0.95 * ambiguous_share(places) * static_cast<double>(places.size()));
  EXPECT_LT(longest, 9.0);
}

TEST(SelfSimilarity, ARoomWithoutSymmetryIsHardlyAmbiguous) {
  EXPECT_LT(ambiguous_share(look_at(test::mini_room(), {.headings = 4}, 1, kAllAround)), 0.2);
}

TEST(SelfSimilarity, ThreadsChangeNothing) {
  const auto one = look_at(test::mini_room(), {.headings = 2}, 1),
             three = look_at(test::mini_room(), {.headings = 2}, 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i].alternatives.size(), three[i].alternatives.size());
    EXPECT_EQ(one[i].resolved_after_m, three[i].resolved_after_m);
    for (std::size_t k = 0; k < one[i].alternatives.size(); ++k)
      EXPECT_EQ(one[i].alternatives[k].log_ratio, three[i].alternatives[k].log_ratio);
  }
}

TEST(SelfSimilarity, BadOptions) {
  EXPECT_THROW((SelfSimilarityOptions{.apart_m = 0.0}.validate()), ConfigurationError);
  EXPECT_THROW((SelfSimilarityOptions{.margin = -1.0}.validate()), ConfigurationError);
  EXPECT_THROW((SelfSimilarityOptions{.headings = 0}.validate()), ConfigurationError);
  EXPECT_THROW((SelfSimilarityOptions{.beams = 2}.validate()), ConfigurationError);
}

}  // namespace
}  // namespace cairn
