#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/recipes.hpp"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace cairn::test {
namespace {

using Filter = ParticleFilter<Pose2, Pose2>;

/// A prediction or a correction, by small whole numbers that shrink well.
struct Step {
  bool is_prediction;
  int x, width;
};

rc::Gen<std::vector<Step>> arbitrary_steps() {
  return rc::gen::container<std::vector<Step>>(rc::gen::build<Step>(
      rc::gen::set(&Step::is_prediction), rc::gen::set(&Step::x, rc::gen::inRange(-5, 6)),
      rc::gen::set(&Step::width, rc::gen::inRange(1, 30))));
}

void apply(Filter& filter, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    if (step.is_prediction) {
      filter.predict({0.05 * step.x, 0.0, 0.02 * step.x});
      continue;
    }
    filter.correct({Time{}, [step](std::span<const Pose2> poses, std::span<double> out) {
                      for (std::size_t i = 0; i < poses.size(); ++i)
                        out[i] = -std::pow((poses[i].x - 0.1 * step.x) / (0.02 * step.width), 2);
                    }});
  }
}

Filter started(const std::string& recipe) {
  LocalizerOptions options;
  options.recipe = recipe;
  options.filter.particles = 200;
  options.filter.min_particles = 100;
  options.filter.max_particles = 800;
  Filter filter = make_filter(options, 1, std::make_shared<const Executor>());
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.3 * n[0], 0.3 * n[1], 0.1 * n[2]};
  });
  return filter;
}

bool same_bytes(const Filter& a, const Filter& b) {
  const auto& p = a.particles();
  const auto& q = b.particles();
  return p.size() == q.size() && a.ess() == b.ess() && a.compact() == b.compact() &&
         std::memcmp(p.states.data(), q.states.data(), p.size() * sizeof(Pose2)) == 0 &&
         std::memcmp(p.log_weights.data(), q.log_weights.data(), p.size() * sizeof(double)) == 0;
}

// What was, what should not have been, and what followed: a checkpoint between them forgets the middle.
RC_GTEST_PROP(Checkpoint, ForgetsWhatCameAfterIt, ()) {
  const auto recipe = *rc::gen::elementOf(std::vector<std::string>{"mcl", "kld_mcl"});
  const auto before = *arbitrary_steps(), wrong = *arbitrary_steps(), after = *arbitrary_steps();
  Filter straight = started(recipe), returned = started(recipe);
  apply(straight, before);
  apply(straight, after);
  apply(returned, before);
  const auto checkpoint = returned.checkpoint();
  apply(returned, wrong);
  returned.restore(checkpoint);
  apply(returned, after);
  RC_ASSERT(same_bytes(straight, returned));
}

}  // namespace
}  // namespace cairn::test
