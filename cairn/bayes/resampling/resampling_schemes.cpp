#include "cairn/bayes/resampling/resampling_schemes.hpp"

#include "cairn/bayes/resampling/multinomial.hpp"
#include "cairn/bayes/resampling/residual.hpp"
#include "cairn/bayes/resampling/stratified.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/bayes/resampling/wheel_of_fortune.hpp"
#include "cairn/core/errors.hpp"

namespace cairn {
namespace {

struct Scheme {
  const char* name;
  std::unique_ptr<Resampling> (*make)();
};

template <class Kind>
std::unique_ptr<Resampling> make() {
  return std::make_unique<Kind>();
}

// Every scheme: one line each.
constexpr Scheme kSchemes[] = {
    {"systematic", make<Systematic>},
    {"stratified", make<Stratified>},
    {"residual", make<Residual>},
    {"multinomial", make<Multinomial>},
    {"wheel_of_fortune", make<WheelOfFortune>},
};

}  // namespace

const std::vector<std::string>& resampling_schemes() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Scheme& scheme : kSchemes) names.emplace_back(scheme.name);
    return names;
  }();
  return kNames;
}

std::unique_ptr<Resampling> make_resampling(const std::string& name) {
  std::string known;
  for (const Scheme& scheme : kSchemes) {
    if (name == scheme.name) return scheme.make();
    known += (known.empty() ? "" : ", ") + std::string(scheme.name);
  }
  throw ConfigurationError("filter.resampling", "'" + name + "' is not known", "use one of " + known);
}

}  // namespace cairn
