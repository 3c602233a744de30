#include "cairn/eval/campaign_tables.hpp"

#include "cairn/eval/metric_style.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

CampaignReport some_report() {
  Campaign campaign;
  campaign.title = "Which is better?";
  campaign.seeds = "1..2";
  campaign.inputs.emplace_back().name = "a, b";
  campaign.recipes = "old new";
  campaign.parameters.emplace_back().name = "default";
  std::vector<CellResult> results;
  for (const CampaignCell& cell : campaign.cells()) {
    CellResult result;
    result.input = "a, b";
    result.recipe = cell.recipe;
    result.variant = cell.variant;
    result.parameters = "default";
    result.seed = cell.seed;
    const double seed_error = 0.01 * static_cast<double>(cell.seed);
    result.metrics = {{"ate_mean_m", seed_error + (cell.recipe == "old" ? 0.02 : 0.01)},
                      {"drop_rate.laser", 0.5}};
    result.trace = {{0.0}, {1.0}, {2.0}, {0.1}};
    results.push_back(result);
  }
  results.pop_back();  // not finished yet
  return make_campaign_report(campaign, results);
}

TEST(CampaignTables, CsvHasARowPerCell) {
  EXPECT_EQ(to_csv(some_report()),
            "input,recipe,parameters,variant,seed,ate_mean_m,drop_rate.laser\n"
            "\"a, b\",old,default,old,1,0.03,0.5\n"
            "\"a, b\",old,default,old,2,0.04,0.5\n"
            "\"a, b\",new,default,new,1,0.02,0.5\n");
}

TEST(CampaignTables, MarkdownShowsMeansAndDifferences) {
  const std::string text = to_markdown(some_report());
  EXPECT_THAT(text, HasSubstr("3 of 4 runs"));
  EXPECT_THAT(text, HasSubstr("| input | variant | runs | drop_rate.laser [%] | ate_mean [cm] |"));
  EXPECT_THAT(text, HasSubstr("| a, b | old | 2 | 50.0 | 3.50 [3.00, 4.00] |"));
  EXPECT_THAT(text, HasSubstr("| a, b | new | 1 | 50.0 | 2.00 |"));
  EXPECT_THAT(text, HasSubstr("| a, b | old | ate_mean [cm] | 3.00 | 3.50 | 4.00 |"));
  EXPECT_THAT(text, HasSubstr("| a, b | new | ate_mean [cm] | 1 | -1.00 | 1.000 |"));
}

TEST(CampaignTables, JsonHasNoTraces) {
  const auto json = nlohmann::json::parse(to_json(some_report()));
  EXPECT_EQ(json["cells"], 4);
  EXPECT_EQ(json["finished"], 3);
  EXPECT_EQ(json["groups"].size(), 2U);
  EXPECT_TRUE(json["groups"][1]["metrics"]["ate_mean_m"]["low"].is_null()) << "one run tells no spread";
  EXPECT_THAT(json["results"][0].dump(), Not(HasSubstr("trace")));
}

TEST(CampaignTables, ThePageHoldsTheTraces) {
  const auto json = nlohmann::json::parse(render_campaign("<!--CAIRN:RUN-->", some_report()));
  EXPECT_EQ(json["traces"].size(), 3U);
  EXPECT_EQ(json["traces"][0]["e"][0], 0.1);
}

TEST(MetricStyle, UnitsByTheEndOfTheName) {
  EXPECT_EQ(style_of("ate_mean_m").label, "ate_mean [cm]");
  EXPECT_EQ(format_metric(style_of("ate_mean_m"), 0.0512), "5.12");
  EXPECT_EQ(format_metric(style_of("rpe_rotation_rad"), 0.01), "0.57");
  EXPECT_EQ(format_metric(style_of("drop_rate.a_m"), 1.0), "100.0");
  EXPECT_EQ(format_metric(style_of("lost"), 0.05), "5.0");
  EXPECT_EQ(format_metric(style_of("updates"), 3.0), "3.00");
  EXPECT_EQ(format_metric(style_of("updates"), std::nan("")), "-");
}

}  // namespace
}  // namespace cairn
