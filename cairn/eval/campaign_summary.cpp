#include "cairn/eval/campaign_summary.hpp"

#include "cairn/eval/ate.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cairn {
namespace {

using Seed = std::pair<std::string, std::uint64_t>;  // input and seed: what pairs two variants

template <typename Key>
std::vector<std::string> in_order(std::span<const CellResult> results, Key key) {
  std::vector<std::string> names;
  for (const CellResult& result : results) {
    if (std::find(names.begin(), names.end(), key(result)) == names.end()) names.push_back(key(result));
  }
  return names;
}

CampaignGroup make_group(std::span<const CellResult> results, const std::string& input,
                         const std::string& variant, const BootstrapOptions& options) {
  CampaignGroup group{input, variant, 0, {}, {}, {}, {}};
  std::map<std::string, std::vector<double>> values;
  for (const CellResult& result : results) {
    if (result.input != input || result.variant != variant) continue;
    ++group.cells;
    for (const auto& [name, value] : result.metrics) values[name].push_back(value);
  }
  for (const auto& [name, all] : values) {
    group.metrics[name] = bootstrap_mean(all, options);
    group.smallest[name] = *std::min_element(all.begin(), all.end());
    group.median[name] = summarize(all).median;
    group.largest[name] = *std::max_element(all.begin(), all.end());
  }
  return group;
}

// Value of a metric per input and seed, for one variant.
std::map<Seed, double> values_of(std::span<const CellResult> results, const std::string& variant,
                                 const std::string& input, const std::string& metric) {
  std::map<Seed, double> values;
  for (const CellResult& result : results) {
    const bool wanted = input == CampaignComparison::kAllInputs || result.input == input;
    const auto found = result.metrics.find(metric);
    if (wanted && result.variant == variant && found != result.metrics.end()) {
      values[{result.input, result.seed}] = found->second;
    }
  }
  return values;
}

void compare(std::span<const CellResult> results, CampaignComparison comparison,
             const BootstrapOptions& options, std::vector<CampaignComparison>& out) {
  const auto& [input, variant, baseline, metric, unused] = comparison;
  const auto before = values_of(results, baseline, input, metric);
  std::vector<double> a, b;
  for (const auto& [seed, value] : values_of(results, variant, input, metric)) {
    const auto found = before.find(seed);
    if (found == before.end()) continue;
    a.push_back(found->second);
    b.push_back(value);
  }
  if (a.empty()) return;
  comparison.paired = compare_paired(a, b, options);
  out.push_back(std::move(comparison));
}

std::set<std::string> metric_names(std::span<const CellResult> results) {
  std::set<std::string> names;
  for (const CellResult& result : results) {
    for (const auto& [name, unused] : result.metrics) names.insert(name);
  }
  return names;
}

}  // namespace

CampaignSummary summarize_campaign(std::span<const CellResult> results, const std::string& baseline,
                                   const BootstrapOptions& options) {
  CampaignSummary summary;
  std::vector<std::string> inputs = in_order(results, [](const CellResult& r) { return r.input; });
  const std::vector<std::string> variants = in_order(results, [](const CellResult& r) { return r.variant; });
  for (const std::string& input : inputs) {
    for (const std::string& variant : variants) {
      CampaignGroup group = make_group(results, input, variant, options);
      if (group.cells > 0) summary.groups.push_back(std::move(group));
    }
  }
  if (inputs.size() > 1) inputs.emplace_back(CampaignComparison::kAllInputs);
  for (const std::string& input : inputs) {
    for (const std::string& variant : variants) {
      if (variant == baseline) continue;
      for (const std::string& metric : metric_names(results)) {
        compare(results, {input, variant, baseline, metric, {}}, options, summary.comparisons);
      }
    }
  }
  return summary;
}

}  // namespace cairn
