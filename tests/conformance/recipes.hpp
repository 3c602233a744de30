#pragma once

#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/bayes/triggers/triggers.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/recipes.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cairn::test {

/// A recipe of the particle filter with one of its parts exchanged.
struct RecipeCase {
  std::string name;
  std::function<void(LocalizerOptions&)> choose;

  LocalizerOptions options() const {
    LocalizerOptions made;
    choose(made);
    return made;
  }
};

/// The plain recipe with every other resampling scheme and every other trigger.
inline void add_variants(const std::string& recipe, std::vector<RecipeCase>& cases) {
  for (const std::string& scheme : resampling_schemes()) {
    if (scheme == LocalizerOptions{}.filter.resampling) continue;
    cases.push_back({recipe + "_" + scheme, [recipe, scheme](LocalizerOptions& o) {
                       o.recipe = recipe;
                       o.filter.resampling = scheme;
                     }});
  }
  for (const std::string& trigger : trigger_names()) {
    if (trigger == LocalizerOptions{}.filter.resample.when) continue;
    cases.push_back({recipe + "_by_" + trigger, [recipe, trigger](LocalizerOptions& o) {
                       o.recipe = recipe;
                       o.filter.resample.when = trigger;
                     }});
  }
}

inline RecipeCase cgr_with(const std::string& model) {
  return {"cgr_" + model, [model](LocalizerOptions& o) {
            o.recipe = "cgr";
            o.laser.model = model;
            o.cgr.particles = 200;  // with 20 the means of two frames differ by chance
          }};
}

/// Every recipe of the registry; the plain ones in all their variants, cgr on cells and on walls.
inline std::vector<RecipeCase> recipes() {
  std::vector<RecipeCase> cases;
  for (const std::string& recipe : recipe_names()) {
    if (recipe == "cgr") {
      for (const std::string model : {"likelihood_field_prob", "v_amcl"}) cases.push_back(cgr_with(model));
      continue;
    }
    cases.push_back({recipe, [recipe](LocalizerOptions& o) { o.recipe = recipe; }});
    if (recipe == "mcl" || recipe == "kld_mcl") add_variants(recipe, cases);
  }
  return cases;
}

}  // namespace cairn::test
