#include "cairn/eval/score.hpp"

#include "cairn/core/errors.hpp"

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_disjoint(const Trajectory& reference, const Trajectory& estimate) {
  const auto span = [](const Trajectory& t) {
    return t.empty() ? std::string("nothing")
                     : format_time(t.front().stamp) + " to " + format_time(t.back().stamp) + " s";
  };
  throw InputError("score",
                   "no reference stamp lies inside the estimate's time span (reference " + span(reference) +
                       ", estimate " + span(estimate) + ")",
                   "check that both come from the same run and clock");
}

Json figures(const Summary& s, const std::string& unit) {
  return {{"mean_" + unit, s.mean}, {"std_" + unit, s.standard_deviation},
          {"rmse_" + unit, s.rms},  {"median_" + unit, s.median},
          {"p95_" + unit, s.p95},   {"max_" + unit, s.max}};
}

Json figures(const Rpe& rpe) {
  return {{"pairs", rpe.pairs},
          {"outside", rpe.outside},
          {"translation_rms_m", rpe.translation_rms_m},
          {"rotation_rms_rad", rpe.rotation_rms_rad},
          {"translation_max_m", rpe.translation_max_m},
          {"rotation_max_rad", rpe.rotation_max_rad}};
}

}  // namespace

Score score(const Trajectory& reference, const Trajectory& estimate, const ScoreOptions& options) {
  const Trajectory moved = move_in_own_frame(estimate, options.T_estimate_reference);
  const auto pairs = associate(reference, moved);
  if (pairs.empty()) refuse_disjoint(reference, estimate);
  Score result;
  result.reference_samples = reference.size();
  result.coverage = static_cast<double>(pairs.size()) / static_cast<double>(reference.size());
  if (options.alignment == Alignment::kRigid) result.T_reference_estimate = rigid_alignment(pairs);
  result.ate = absolute_trajectory_error(aligned(pairs, result.T_reference_estimate));
  result.rpe = options.relations.empty()
                   ? relative_pose_error(moved, relations_over_distance(reference, options.rpe_delta_m))
                   : relative_pose_error(moved, options.relations);
  result.lost = judge_lost(result.ate.errors, options.lost);
  return result;
}

std::string to_json(const Score& score) {
  const Pose2& T = score.T_reference_estimate;
  const Json json = {{"reference_samples", score.reference_samples},
                     {"matched_samples", score.ate.errors.size()},
                     {"coverage", score.coverage},
                     {"alignment", {{"x_m", T.x}, {"y_m", T.y}, {"theta_rad", T.theta}}},
                     {"position", figures(score.ate.position_m, "m")},
                     {"heading", figures(score.ate.heading_rad, "rad")},
                     {"relative", figures(score.rpe)},
                     {"lost", score.lost.lost},
                     {"ends_lost", score.lost.ends_lost},
                     {"bad_share", score.lost.bad_share}};
  return json.dump(2);
}

}  // namespace cairn
