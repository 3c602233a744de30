#include "cairn/eval/cell_result.hpp"

#include "cairn/core/errors.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

CellResult some_result() {
  CellResult result;
  result.id = "0123";
  result.input = "office";
  result.recipe = "mcl";
  result.parameters = "default";
  result.variant = "mcl";
  result.seed = 18446744073709551615ULL;
  result.program = "0.1 f00";
  result.command = "cairn localize \"x\"";
  result.metrics = {{"ate_mean_m", 0.1 + 0.2}, {"lost", 0.0}};
  result.trace = {{0.0, 1.0}, {1.0, 2.0}, {3.0, 4.0}, {0.5, 0.25}};
  return result;
}

// A straight drive of one pose per second; the estimate is `error_m(t)` off to the left.
Trajectory straight(double (*error_m)(int), int seconds) {
  Trajectory path;
  for (int t = 0; t <= seconds; ++t) path.push_back({time_from_seconds(t), {0.5 * t, error_m(t), 0.0}});
  return path;
}

CellResult judged(double (*error_m)(int), int seconds) {
  const Trajectory truth = straight([](int) { return 0.0; }, seconds);
  CellResult result;
  add_accuracy(score(truth, straight(error_m, seconds)), truth, result);
  return result;
}

TEST(CellResult, ComesBackAsWritten) {
  const CellResult written = some_result();
  const CellResult read = cell_result_from_json(to_json(written), "x");
  EXPECT_EQ(read.id, written.id);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.command, written.command);
  EXPECT_EQ(read.metrics, written.metrics);
  EXPECT_EQ(read.trace.error_m, written.trace.error_m);
  EXPECT_EQ(to_json(read), to_json(written));
}

TEST(CellResult, LeavesOutWhatIsNotFinite) {
  CellResult result = some_result();
  result.metrics["nothing"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cell_result_from_json(to_json(result), "x").metrics.count("nothing"), 0U);
}

TEST(CellResult, RefusesEveryCut) {
  const std::string text = to_json(some_result());
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_THROW(cell_result_from_json(text.substr(0, length), "x"), InputError);
  }
  EXPECT_THROW(cell_result_from_json("[]", "x"), InputError);
  EXPECT_THROW(cell_result_from_json(R"({"id": 3})", "x"), InputError);
}

TEST(CellResult, AccuracyOfAConstantError) {
  const CellResult result = judged([](int) { return 0.2; }, 100);
  EXPECT_NEAR(result.metrics.at("ate_mean_m"), 0.2, 1e-12);
  EXPECT_NEAR(result.metrics.at("rpe_translation_m"), 0.0, 1e-9);
  EXPECT_EQ(result.metrics.at("lost"), 0.0);
  EXPECT_EQ(result.metrics.at("converged_s"), 0.0);
  EXPECT_EQ(result.trace.t_s.size(), 101U);
  EXPECT_EQ(result.trace.x_m.back(), 50.0);
}

TEST(CellResult, ConvergesWhereTheErrorStaysSmall) {
  // Good for three seconds only, then from second 20 on.
  const CellResult result = judged([](int t) { return (t < 5 || t > 7) && t < 20 ? 3.0 : 0.1; }, 100);
  EXPECT_DOUBLE_EQ(result.metrics.at("converged_s"), 20.0);
  EXPECT_NEAR(result.metrics.at("final_error_m"), 0.1, 1e-12);
  EXPECT_EQ(result.metrics.at("lost"), 1.0);
  EXPECT_EQ(judged([](int) { return 3.0; }, 100).metrics.count("converged_s"), 0U);
}

TEST(CellResult, LongRunsAreThinnedOut) {
  const CellResult result = judged([](int) { return 0.2; }, 5000);
  EXPECT_LE(result.trace.t_s.size(), 400U);
  EXPECT_EQ(result.trace.t_s.back(), 5000.0);
}

}  // namespace
}  // namespace cairn
