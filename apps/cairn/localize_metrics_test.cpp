#include "apps/cairn/localize_metrics.hpp"

#include "small_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::app {
namespace {

using ::testing::HasSubstr;

// A run of ten scans, one per second, that stands still at the origin.
class SummarizeRun : public ::testing::Test {
 protected:
  SummarizeRun() {
    log_.format = "carmen";
    log_.streams = test::odometry_and_laser();
    for (int i = 0; i < 10; ++i) {
      log_.events.push_back(test::odometry_event(i, {}));
      Estimate e;
      e.stamp = test::at(i);
      e.quality = 0.9;
      e.weight = 1.0;
      result_.estimates.push_back(e);
    }
    result_.outcomes.resize(2);
    result_.outcomes[0][static_cast<std::size_t>(Outcome::kUsed)] = 10;
    result_.outcomes[1][static_cast<std::size_t>(Outcome::kNotNeeded)] = 10;
    result_.diagnostics.warn("duplicate scan", "here", "twice");
    log_.diagnostics.count("duplicate scan", 2);
  }

  // A reference that stands still at x, from `begin` to `begin` + 9 s.
  static Trajectory standing(double x, double begin = 0.0) {
    Trajectory reference;
    for (int i = 0; i < 10; ++i) reference.push_back({test::at(begin + i), {x, 0.0, 0.0}});
    return reference;
  }

  RunSummary summarize(const std::optional<Trajectory>& reference) const {
    return summarize_run({.log_path = "a.log", .map_path = "a.yaml", .seed = 7}, log_, test::small_room(), {},
                         reference, {}, result_);
  }

  Log log_;
  LocalizeResult result_;
};

TEST_F(SummarizeRun, TellsTheOutcomesPerStreamAndAddsUpTheWarnings) {
  const RunSummary summary = summarize({});
  const auto& m = summary.metrics;
  EXPECT_EQ(m["outcomes"]["laser"], (nlohmann::json{{"not_needed", 10}}));
  EXPECT_EQ(m["log"]["streams"][0]["messages"], 10);
  EXPECT_EQ(m["log"]["span_s"], 9.0);
  EXPECT_EQ(m["warnings"]["duplicate scan"], 3);
  EXPECT_EQ(m["seed"], 7);
  EXPECT_FALSE(m.contains("accuracy"));
  EXPECT_EQ(m["verdict"], "tracking");
  EXPECT_THAT(summary.text, HasSubstr("warning   duplicate scan: 3"));
  EXPECT_THAT(summary.text, HasSubstr("; at the end tracking, right with a probability of"));
}

TEST_F(SummarizeRun, MeasuresTheAccuracyWhereThereIsAReference) {
  const RunSummary summary = summarize(standing(0.3));
  EXPECT_EQ(summary.metrics["verdict_reason"],
            "100 % of the poses lie within 1 m and 45 degrees of the reference");
  EXPECT_NEAR(summary.metrics["accuracy"]["ate_mean_m"].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(summary.metrics["accuracy"]["matched"], 10);
  EXPECT_FALSE(summary.lost);
  EXPECT_THAT(summary.text, HasSubstr("mean 30.0 cm"));
}

TEST_F(SummarizeRun, TheReferenceDecidesWhoIsLost) {
  EXPECT_TRUE(summarize(standing(3.0)).lost);
  EXPECT_THAT(summarize(standing(3.0)).reason, HasSubstr("off the reference"));
  for (Estimate& e : result_.estimates) e.quality = 0.1;
  EXPECT_TRUE(summarize({}).lost);
  EXPECT_FALSE(summarize(standing(0.0)).lost) << "the map is wrong, the pose is not";
}

TEST_F(SummarizeRun, AReferenceOfAnotherTimeIsNoAccuracyButAWarning) {
  const RunSummary summary = summarize(standing(0.0, 1000.0));
  EXPECT_FALSE(summary.metrics.contains("accuracy"));
  EXPECT_THAT(summary.text, HasSubstr("no reference pose inside the estimates"));
  result_.estimates.clear();
  EXPECT_FALSE(summarize(standing(0.0)).metrics.contains("accuracy"));
  EXPECT_EQ(summarize(standing(0.0)).metrics["verdict"], "lost");
}

}  // namespace
}  // namespace cairn::app
