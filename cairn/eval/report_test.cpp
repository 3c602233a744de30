#include "cairn/eval/report.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kPage = "<html><!--CAIRN:RUN--></html>";

Time at(double seconds) { return time_from_seconds(seconds); }

std::string script_of(const ReportData& run) {
  const std::string page = render_report(kPage, run);
  EXPECT_THAT(page, testing::StartsWith("<html>{"));
  EXPECT_THAT(page, testing::EndsWith("}</html>"));
  return page.substr(6, page.size() - 13);
}

json data_of(const ReportData& run) { return json::parse(script_of(run)); }

// A drive along x at 1 m/s, `steps` estimates at 10 Hz, 3 cm off in y.
ReportData drive(int steps) {
  ReportData run;
  run.metrics = R"({"cairn_version": "0.1.0"})";
  run.reference.emplace();
  for (int i = 0; i < steps; ++i) {
    Estimate e;
    e.stamp = at(5e8 + 0.1 * i);
    e.T_map_base = {0.1 * i, 0.03, -0.2};
    e.covariance.diagonal() << 0.0009, 0.0016, 0.04;
    e.ess = 100.0;
    e.particles = 200;
    run.estimates.push_back(e);
    run.trajectory.push_back({e.stamp, e.T_map_base});
    run.reference->push_back({e.stamp, {0.1 * i, 0.0, 0.0}});
  }
  return run;
}

TEST(Report, NothingInTheDataEndsTheScript) {
  ReportData run = drive(3);
  run.metrics = R"({"log": {"path": "</script><img src=x onerror=alert(1)>"}, "warnings": {"<!--": 1}})";
  run.configuration = "a: </SCRIPT>\n";
  EXPECT_THAT(script_of(run), Not(HasSubstr("<")));
  const json data = data_of(run);
  EXPECT_EQ(data["metrics"]["log"]["path"], "</script><img src=x onerror=alert(1)>");
  EXPECT_EQ(data["metrics"]["warnings"]["<!--"], 1);
  EXPECT_EQ(data["configuration"], "a: </SCRIPT>\n");
}

TEST(Report, BytesThatAreNotTextBecomeReplacementCharacters) {
  ReportData run = drive(2);
  run.configuration = "caf\xE9";
  EXPECT_EQ(data_of(run)["configuration"], "caf\xEF\xBF\xBD");
}

TEST(Report, HoldsTheErrorsAgainstTheReference) {
  const json data = data_of(drive(50));
  ASSERT_EQ(data["errors"]["position_m"].size(), 50u);
  EXPECT_DOUBLE_EQ(data["errors"]["position_m"][7], 0.03);
  EXPECT_DOUBLE_EQ(data["errors"]["heading_rad"][7], 0.2);
  EXPECT_DOUBLE_EQ(data["errors"]["t"][7], 0.7);
  EXPECT_DOUBLE_EQ(data["series"]["position_error_m"]["v"][49], 0.03);
  EXPECT_DOUBLE_EQ(data["series"]["sigma_position_m"]["v"][0], 0.05);
  EXPECT_DOUBLE_EQ(data["series"]["sigma_theta_rad"]["v"][0], 0.2);
  std::int64_t counted = 0;
  for (const std::int64_t n : data["histograms"]["position"]["counts"]) counted += n;
  EXPECT_EQ(counted, 50);
}

TEST(Report, LeavesOutWhatIsNotThere) {
  ReportData run = drive(5);
  run.reference.reset();
  EXPECT_FALSE(data_of(run).contains("errors"));
  EXPECT_FALSE(data_of(run).contains("histograms"));
  EXPECT_FALSE(data_of(run).contains("map"));
  run = {};
  run.metrics = "{}";
  EXPECT_TRUE(data_of(run)["path"]["t"].empty());
  EXPECT_TRUE(data_of(run)["series"]["ess"]["v"].empty());
}

TEST(Report, AReferenceOfAnotherTimeGivesNoErrors) {
  ReportData run = drive(5);
  for (StampedPose& pose : *run.reference) pose.stamp += duration_from_seconds(1000.0);
  EXPECT_TRUE(data_of(run).contains("reference"));
  EXPECT_FALSE(data_of(run).contains("errors"));
}

TEST(Report, ALongRunKeepsItsPeaksAndStaysSmall) {
  ReportData run = drive(27'000);  // 45 minutes
  run.trajectory[12'345].pose.y = 2.5;
  for (int i = 0; i < 2700; ++i) {
    run.particles.push_back({at(5e8 + i), std::vector<Pose2>(500, Pose2{123.456, -98.765, 3.14159})});
  }
  const json data = data_of(run);
  const std::vector<double> errors = data["series"]["position_error_m"]["v"];
  EXPECT_LE(errors.size(), 4000u);
  EXPECT_DOUBLE_EQ(*std::max_element(errors.begin(), errors.end()), 2.5);
  EXPECT_LE(data["particles"]["t"].size(), 400u);
  EXPECT_EQ(data["particles"]["mm"][0].size(), 3u * 120u);
  EXPECT_EQ(data["particles"]["mm"][0][1], -98765);
  // The page itself takes 0.6 MB, a map seldom more than 0.3 MB.
  EXPECT_LT(render_report(kPage, run).size(), 3'000'000u);
}

TEST(Report, PutsTheMapInItsPlace) {
  ReportData run = drive(2);
  run.map = ReportMap{"foobar", GridGeometry{40, 30, 0.05, {-1.0, 2.0, 0.25}}};
  const json map = data_of(run)["map"];
  EXPECT_EQ(map["png"], "Zm9vYmFy");
  EXPECT_EQ(map["width"], 40);
  EXPECT_EQ(map["origin"], (json{-1.0, 2.0, 0.25}));
}

TEST(Report, ShowsWhatIsNotANumberAsMissing) {
  ReportData run = drive(3);
  run.estimates[1].ess = std::numeric_limits<double>::quiet_NaN();
  run.estimates[1].covariance(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(data_of(run)["belief"]["ess"][1].is_null());
  EXPECT_TRUE(data_of(run)["belief"]["var_x"][1].is_null());
}

TEST(Report, RefusesMetricsThatAreNoObjectAndAPageWithoutAPlace) {
  ReportData run = drive(2);
  EXPECT_THROW(render_report("<html></html>", run), std::logic_error);
  for (const char* text : {"", "{", "[1]", "3"}) {
    run.metrics = text;
    EXPECT_THROW(render_report(kPage, run), InputError) << text;
  }
}

}  // namespace
}  // namespace cairn
