#include "apps/cairn/beam_samples.hpp"

#include "cairn/core/errors.hpp"
#include "small_room.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

// Scans of the small room at one per second, from poses on a circle.
PosedScans driven(int count) {
  PosedScans posed;
  for (int i = 0; i < count; ++i) {
    const Pose2 pose = test::on_circle({2.0, 2.0, 0.3}, i);
    posed.scans.push_back(
        {pose, std::make_shared<const LaserScan>(test::scan_from(test::small_room(), pose, test::at(i)))});
  }
  return posed;
}

TEST(BeamSamples, TheReadingsOfTheTruePosesAreThoseOfTheMap) {
  const BeamSamples samples = collect_beam_samples(driven(10), test::small_room(), test::at(0),
                                                   {"--spans", ""}, {.beams_per_scan = 12});
  EXPECT_EQ(samples.scans, 10U);
  ASSERT_EQ(samples.learn.size(), 120U);
  EXPECT_TRUE(samples.rest.empty());
  for (const BeamSample& s : samples.learn) EXPECT_NEAR(s.z_m, s.expected_m, 0.05);
}

TEST(BeamSamples, SpansDivideTheScans) {
  const BeamSamples samples = collect_beam_samples(driven(10), test::small_room(), test::at(0),
                                                   {"--spans", "2-5"}, {.beams_per_scan = 12});
  EXPECT_EQ(samples.learn.size(), 36U);
  EXPECT_EQ(samples.rest.size(), 84U);
  EXPECT_THROW(collect_beam_samples(driven(3), test::small_room(), test::at(0), {"--spans", "50-60"}, {}),
               InputError);
}

TEST(BeamSamples, FewScansAreSpreadEvenly) {
  const BeamSamples samples = collect_beam_samples(driven(10), test::small_room(), test::at(0),
                                                   {"--spans", ""}, {.beams_per_scan = 1, .most_scans = 6});
  EXPECT_EQ(samples.scans, 5U);
}

}  // namespace
}  // namespace cairn::app
