#include "cairn/eval/campaign_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CellResult run(const std::string& variant, std::uint64_t seed, double error) {
  CellResult result;
  result.input = "an office";
  result.variant = result.recipe = variant;
  result.seed = seed;
  result.metrics = {{"ate_mean_m", error}, {"ate_max_m", error}, {"cpu_s", 1.0}};
  result.trace = {{0.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}, {error, 2.0 * error}};
  return result;
}

CellResult noise(const std::string& variant, std::uint64_t seed, std::vector<double> quantiles) {
  CellResult result;
  result.input = "hall";
  result.variant = variant;
  result.seed = seed;
  result.metrics = {{"hit_share", 0.9}};
  result.distributions["beam"] = std::move(quantiles);
  return result;
}

CampaignReport report_of(Campaign campaign, std::vector<CellResult> results) {
  campaign.inputs.emplace_back().name = "x";
  campaign.parameters.emplace_back().name = "default";
  return make_campaign_report(campaign, std::move(results));
}

TEST(CampaignFigures, OnePictureForEachInput) {
  const auto figures = campaign_figures(report_of({}, {run("mcl", 1, 0.1), run("cgr", 1, 0.2)}));
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].name, "an-office");
  EXPECT_THAT(figures[0].svg, HasSubstr("runs within 1 m"));
  EXPECT_THAT(figures[0].svg, HasSubstr(">cgr</text>"));
}

TEST(CampaignFigures, HistogramsAndCurvesOfConvergenceAreDrawnWhereThereIsSomethingToDraw) {
  std::vector<CellResult> results;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    results.push_back(run("mcl", seed, 0.1));
    results.back().metrics["final_error_m"] = seed == 4 ? 10.0 : 0.01;
    results.back().metrics["converged_s"] = 0.0;
  }
  const std::string known = campaign_figures(report_of({}, results))[0].svg;
  EXPECT_THAT(known, HasSubstr("histogram of the errors at the end"));
  EXPECT_THAT(known, Not(HasSubstr("runs that have converged")));
  results[0].metrics["converged_s"] = 3.0;
  const std::string unknown = campaign_figures(report_of({}, results))[0].svg;
  EXPECT_THAT(unknown, HasSubstr("runs that have converged"));
  results[0].metrics["final_error_m"] = 10.0;
  EXPECT_NE(campaign_figures(report_of({}, results))[0].svg, unknown) << "two of four are at 10 m now";
}

// Each run errs by `error` and twice that.
TEST(CampaignFigures, TheColoursOfTheErrorMapReachAsFarAsTheErrors) {
  Campaign campaign;
  campaign.baseline = "mcl";
  const auto map_of = [&](double error) {
    return campaign_figures(report_of(campaign, {run("mcl", 1, error)}))[0].svg;
  };
  EXPECT_THAT(map_of(0.02), HasSubstr("dark 0 to bright 0.05 m"));
  EXPECT_THAT(map_of(0.15), HasSubstr("dark 0 to bright 0.2 m"));
  EXPECT_THAT(map_of(50.0), HasSubstr("dark 0 to bright 10 m"));
}

TEST(CampaignFigures, SetsOfParametersMakeACurveOfCost) {
  std::vector<CellResult> results;
  for (const char* recipe : {"mcl", "cgr"}) {
    for (const char* parameters : {"10", "100", "1000"}) {
      results.push_back(run(std::string(recipe) + " " + parameters, 1, 0.1));
      results.back().recipe = recipe;
      results.back().parameters = parameters;
    }
  }
  const auto figures = campaign_figures(report_of({}, results));
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].name, "cost-an-office");
}

TEST(CampaignFigures, SensorsAreComparedByTheirQuantiles) {
  Campaign campaign;
  campaign.task = kTaskSensors;
  const CampaignReport report =
      report_of(campaign, {noise("real", 1, {-1.0, 0.0, 1.0}), noise("simulated", 1, {-1.5, 0.5, 1.0}),
                           noise("simulated", 2, {-0.5, 0.5, 2.0})});
  EXPECT_THAT(mean_quantiles(report, "hall", "simulated", "beam"), ElementsAre(-1.0, 0.5, 1.5));
  EXPECT_THAT(mean_quantiles(report, "hall", "simulated", "uwb"), IsEmpty());
  EXPECT_DOUBLE_EQ(
      distribution_distance(std::vector<double>{-1.0, 0.0, 1.0}, std::vector<double>{-1.0, 0.5, 1.5}),
      1.0 / 3.0);
  ASSERT_EQ(campaign_figures(report).size(), 1U);
  const std::string tables = to_markdown(report);
  EXPECT_THAT(tables, HasSubstr("## hall"));
  EXPECT_THAT(tables,
              HasSubstr("| beam [cm] | -100.00 / 0.00 / 100.00 | -100.00 / 50.00 / 150.00 | 33.33 |"));
}

}  // namespace
}  // namespace cairn
