// Scores of the Rawseeds trajectories (Bicocca 2009-02-25a, 25b, 26a) against figures that an independent
// script computed with the same definition: rigid alignment, ATE mean +- sample standard deviation (cm), RPE
// root mean square over the relations (cm, degrees); `plain` and after moving the estimate 0.08 m forward
// (base -> laser).
#include "cairn/core/angle.hpp"
#include "cairn/eval/score.hpp"
#include "cairn/io/relations.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "test_data.hpp"

#include <string>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kToleranceCm = 0.02;
constexpr double kToleranceDegrees = 0.01;

struct Figures {
  double mean_cm, std_cm, translation_cm, rotation_degrees;
};

struct Row {
  const char* set;
  const char* file;
  Figures plain, moved;
};

const Row kRows[] = {
    {"25a", "amcl_beam_model_default", {12.16, 7.76, 2.19, 0.65}, {8.67, 6.66, 2.21, 0.65}},
    {"25a", "muse_beam_model_default_new_cluster", {10.15, 6.54, 4.91, 0.76}, {6.07, 7.23, 4.92, 0.76}},
    {"25a", "amcl_likelihood_default", {18.13, 7.60, 1.96, 0.59}, {12.27, 7.03, 1.97, 0.59}},
    {"25a", "muse_likelihood_field_default_new_cluster", {8.31, 2.31, 1.50, 0.78}, {2.66, 1.72, 1.52, 0.78}},
    {"25a", "ndt_mcl_0.5", {6.46, 6.21, 2.31, 0.77}, {7.97, 5.52, 2.33, 0.77}},
    {"25b", "amcl_beam_model_default", {17.38, 6.73, 1.94, 0.58}, {12.21, 7.12, 1.95, 0.58}},
    {"25b", "muse_beam_model_default_new_cluster", {8.66, 4.20, 1.69, 0.73}, {6.25, 4.59, 1.71, 0.73}},
    {"25b", "amcl_likelihood_default", {17.66, 7.22, 1.87, 0.57}, {12.54, 7.63, 1.88, 0.57}},
    {"25b", "muse_likelihood_field_default_new_cluster", {6.71, 2.83, 1.60, 0.76}, {3.88, 2.97, 1.61, 0.76}},
    {"25b", "ndt_mcl_0.5", {6.12, 8.50, 2.39, 0.78}, {7.94, 7.26, 2.40, 0.78}},
    {"26a", "amcl_beam_model_default", {12.77, 7.78, 2.18, 0.70}, {9.24, 7.09, 2.20, 0.70}},
    {"26a", "muse_beam_model_default_new_cluster", {9.84, 5.39, 1.52, 0.82}, {5.93, 5.27, 1.55, 0.82}},
    {"26a", "amcl_likelihood_default", {19.61, 8.25, 2.01, 0.66}, {14.35, 7.68, 2.03, 0.66}},
    {"26a", "muse_likelihood_field_default_new_cluster", {7.65, 2.94, 2.09, 0.97}, {3.28, 2.30, 2.11, 0.97}},
    {"26a", "ndt_mcl_0.5", {6.89, 8.48, 2.31, 0.83}, {8.70, 7.74, 2.33, 0.83}},
};

class Rawseeds : public ::testing::TestWithParam<Row> {};

void expect_figures(const Score& score, const Figures& expected) {
  EXPECT_NEAR(100 * score.ate.position_m.mean, expected.mean_cm, kToleranceCm);
  EXPECT_NEAR(100 * score.ate.position_m.standard_deviation, expected.std_cm, kToleranceCm);
  EXPECT_NEAR(100 * score.rpe.translation_rms_m, expected.translation_cm, kToleranceCm);
  EXPECT_NEAR(radians_to_degrees(score.rpe.rotation_rms_rad), expected.rotation_degrees, kToleranceDegrees);
}

TEST_P(Rawseeds, ScoreIsTheIndependentOne) {
  const Row& row = GetParam();
  const std::string set = "Bicocca_2009-02-" + std::string(row.set);
  const std::string folder = "rawseeds_eval/" + set + "/";
  const std::string reference_name = folder + set + "-GROUNDTRUTH-CARTOGRAPHER";
  CAIRN_SKIP_WITHOUT(reference_name + ".csv");
  const Trajectory reference = read_trajectory(test::data_file(reference_name + ".csv"));
  const Trajectory estimate = read_trajectory(test::data_file(folder + row.file + ".csv"));
  ScoreOptions options;
  options.alignment = Alignment::kRigid;
  options.relations = read_relations(test::data_file(reference_name + ".relations"));
  expect_figures(score(reference, estimate, options), row.plain);
  options.T_estimate_reference = {0.08, 0.0, 0.0};
  expect_figures(score(reference, estimate, options), row.moved);
}

std::string name_of(const ::testing::TestParamInfo<Row>& info) {
  std::string name = std::string(info.param.set) + "_" + info.param.file;
  for (char& c : name) c = c == '.' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Bicocca, Rawseeds, ::testing::ValuesIn(kRows), name_of);

}  // namespace
}  // namespace cairn
