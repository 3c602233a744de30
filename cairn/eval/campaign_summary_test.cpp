#include "cairn/eval/campaign_summary.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

CellResult cell(const std::string& input, const std::string& variant, std::uint64_t seed, double error) {
  CellResult result;
  result.input = input;
  result.variant = variant;
  result.seed = seed;
  result.metrics["error"] = error;
  return result;
}

TEST(CampaignSummary, GroupsInputsAndVariantsInTheirOrder) {
  const std::vector results{cell("z", "new", 1, 1.0), cell("z", "new", 2, 3.0), cell("z", "new", 3, 8.0),
                            cell("a", "old", 1, 5.0)};
  const CampaignSummary summary = summarize_campaign(results, "old");
  ASSERT_EQ(summary.groups.size(), 2U);
  EXPECT_EQ(summary.groups[0].input, "z");
  EXPECT_EQ(summary.groups[0].cells, 3U);
  EXPECT_DOUBLE_EQ(summary.groups[0].metrics.at("error").mean, 4.0);
  EXPECT_EQ(summary.groups[0].smallest.at("error"), 1.0);
  EXPECT_EQ(summary.groups[0].median.at("error"), 3.0);
  EXPECT_EQ(summary.groups[0].largest.at("error"), 8.0);
  EXPECT_EQ(summary.groups[1].variant, "old");
}

TEST(CampaignSummary, PairsByInputAndSeed) {
  // Out of order, and seed 3 has no partner.
  const std::vector results{cell("a", "old", 1, 10.0), cell("a", "old", 2, 20.0), cell("a", "new", 2, 19.0),
                            cell("a", "new", 1, 8.0),  cell("a", "new", 3, 99.0), cell("b", "old", 1, 1.0),
                            cell("b", "new", 1, 1.0)};
  const CampaignSummary summary = summarize_campaign(results, "old");
  ASSERT_EQ(summary.comparisons.size(), 3U);
  EXPECT_EQ(summary.comparisons[0].input, "a");
  EXPECT_EQ(summary.comparisons[0].paired.difference.count, 2U);
  EXPECT_DOUBLE_EQ(summary.comparisons[0].paired.difference.mean, -1.5);
  EXPECT_EQ(summary.comparisons[2].input, CampaignComparison::kAllInputs);
  EXPECT_EQ(summary.comparisons[2].paired.difference.count, 3U);
  EXPECT_DOUBLE_EQ(summary.comparisons[2].paired.difference.mean, -1.0);
}

TEST(CampaignSummary, AMetricThatOneLacksIsNotCompared) {
  std::vector results{cell("a", "old", 1, 1.0), cell("a", "new", 1, 2.0)};
  results[1].metrics["only_here"] = 1.0;
  EXPECT_EQ(summarize_campaign(results, "old").comparisons.size(), 1U);
  EXPECT_TRUE(summarize_campaign(results, "unknown").comparisons.empty());
  EXPECT_TRUE(summarize_campaign({}, "old").groups.empty());
}

}  // namespace
}  // namespace cairn
