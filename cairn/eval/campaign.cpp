#include "cairn/eval/campaign.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

namespace cairn {
namespace {

constexpr const char* kSeedsRemedy = "write for example 1..10 or 1,2,5";
constexpr std::size_t kMostSeeds = 10'000;
constexpr double kLongest_s = 24.0 * 3600.0;

std::uint64_t parse_number(const std::string& key, const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) {
    throw ConfigurationError(key, "holds '" + text.substr(0, 40) + "', which is no seed", kSeedsRemedy);
  }
  return value;
}

void append_seeds(const std::string& key, const std::string& part, std::vector<std::uint64_t>& seeds) {
  const std::size_t dots = part.find("..");
  const std::uint64_t first = parse_number(key, part.substr(0, dots));
  const std::uint64_t last = dots == std::string::npos ? first : parse_number(key, part.substr(dots + 2));
  if (last < first) throw ConfigurationError(key, "counts downwards", kSeedsRemedy);
  if (last - first >= kMostSeeds) throw ConfigurationError(key, "names more than 10000 seeds", "name fewer");
  for (std::uint64_t seed = first; seed - first <= last - first; ++seed) {
    seeds.push_back(seed);
    if (seed == last) break;
  }
}

template <typename Entry>
Entry& entry_named(std::vector<Entry>& entries, const std::string& name) {
  for (Entry& entry : entries) {
    if (entry.name == name) return entry;
  }
  entries.emplace_back().name = name;
  return entries.back();
}

template <typename Entry>
void visit_table(OptionVisitor& visitor, const OptionVisitor::Field& field, std::vector<Entry>& entries) {
  std::vector<std::string> present;
  present.reserve(entries.size());
  for (const Entry& entry : entries) present.push_back(entry.name);
  visitor.table(field, present, [&entries](const std::string& key, OptionVisitor& inner) {
    entry_named(entries, key).visit(inner);
  });
}

void check_settings(const std::string& key, const std::string& set) {
  for (const std::string& setting : split_words(set)) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw ConfigurationError(key + ".set", "holds '" + setting.substr(0, 60) + "', which is not key=value",
                               "write for example filter.particles=500, settings separated by blanks");
    }
  }
}

void check_sensor_input(const CampaignInput& input) {
  const std::string key = "inputs." + input.name;
  if (!input.log.empty() && !input.map.empty() && !input.reference.empty() && !input.world.empty()) return;
  throw ConfigurationError(key, "lacks a log, its map, its reference, or the world of the same drive",
                           "give all four: task: sensors compares them");
}

void check_sensor_campaign(const Campaign& campaign) {
  for (const CampaignInput& input : campaign.inputs) check_sensor_input(input);
  if (campaign.recipes.empty() && campaign.parameters.empty()) return;
  throw ConfigurationError(campaign.recipes.empty() ? "parameters" : "recipes",
                           "mean nothing where task is sensors: nothing is localized", "remove them");
}

// The log once, the world with every seed.
std::vector<CampaignCell> sensor_cells(const Campaign& campaign, const std::vector<std::uint64_t>& seeds) {
  std::vector<CampaignCell> cells;
  for (std::size_t input = 0; input < campaign.inputs.size(); ++input) {
    cells.push_back({cells.size(), input, "", 0, seeds.front(), kVariantReal});
    for (const std::uint64_t seed : seeds)
      cells.push_back({cells.size(), input, "", 0, seed, kVariantSimulated});
  }
  return cells;
}

void check_input(const CampaignInput& input) {
  const std::string key = "inputs." + input.name;
  if (input.world.empty() == input.log.empty()) {
    throw ConfigurationError(
        key, input.world.empty() ? "names neither a log nor a world" : "names both a log and a world",
        "give `log`, `map` and `reference`, or `world`");
  }
  if (!input.world.empty() && !(input.map.empty() && input.reference.empty())) {
    throw ConfigurationError(key + ".world", "comes with its own map and reference",
                             "remove those of the input");
  }
  if (!input.log.empty() && input.map.empty()) {
    throw ConfigurationError(key + ".map", "is missing", "name the map of the log");
  }
  if (!input.log.empty() && input.start == "reference" && input.reference.empty()) {
    throw ConfigurationError(key + ".start", "is `reference`, but there is none",
                             "give `reference`, or start: global, or start: x,y,yaw");
  }
  if (input.world_seed != "each") parse_number(key + ".world_seed", input.world_seed);
  check_settings(key, input.settings.set);
  check_settings(key + ".world", input.world_set);
}

std::string variant_name(const Campaign& campaign, const std::string& recipe, const std::string& parameters,
                         std::size_t recipes) {
  if (recipes <= 1 && campaign.parameters.size() == 1) return recipe.empty() ? parameters : recipe;
  if (campaign.parameters.size() == 1) return recipe;
  return recipes <= 1 ? parameters : recipe + " " + parameters;
}

}  // namespace

std::vector<std::string> split_words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::uint64_t> parse_seeds(const std::string& key, const std::string& text) {
  std::vector<std::uint64_t> seeds;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const std::size_t first = part.find_first_not_of(' ');
    const std::size_t last = part.find_last_not_of(' ');
    append_seeds(key, first == std::string::npos ? "" : part.substr(first, last - first + 1), seeds);
  }
  if (seeds.empty()) throw ConfigurationError(key, "names no seed", kSeedsRemedy);
  if (seeds.size() > kMostSeeds) throw ConfigurationError(key, "names more than 10000 seeds", "name fewer");
  if (std::set<std::uint64_t>(seeds.begin(), seeds.end()).size() != seeds.size()) {
    throw ConfigurationError(key, "names a seed twice", "a repeated run tells nothing new: remove one");
  }
  return seeds;
}

void CampaignSettings::visit(OptionVisitor& v) {
  v.text({"config", "Configuration file, relative to the campaign's folder"}, config);
  v.text({"set", "key=value settings separated by blanks, as --set takes them"}, set);
}

void CampaignInput::visit(OptionVisitor& v) {
  v.text({"log", "Recording, relative to the campaign's folder; $CAIRN_DATA is replaced"}, log);
  v.text({"map", "Map of the recording"}, map);
  v.text({"reference", "Trajectory taken as true"}, reference);
  v.text({"world", "World to simulate instead: a built-in name or a world file"}, world);
  v.text({"world_set", "key=value settings of the world, as `cairn simulate --set` takes them"}, world_set);
  v.text({"world_seed", "Seed of the simulation; each: that of the cell, another drive for every seed"},
         world_seed);
  v.number({"duration_s", "Length of the simulated drive; 0: as the world says"}, duration_s,
           {0.0, kLongest_s});
  v.text({"start", "reference, global, or x,y,yaw (m, rad)"}, start);
  v.text({"start_error", "x,y,yaw added to the start pose (m, rad)"}, start_error);
  v.flag({"live", "Messages in the order of their arrival, as `cairn localize --live`"}, live);
  v.text({"stream", "task sensors: laser of the log, where it has several"}, stream);
  v.text({"odometry", "task sensors: odometry of the log; none: the first"}, odometry);
  v.choice({"trajectory_frame", "task sensors: whose poses the reference holds"}, trajectory_frame,
           {"base", "sensor"});
  v.number({"max_gap_s", "task sensors: the reference is not interpolated over longer gaps"}, max_gap_s,
           {0.0, 1e6});
  settings.visit(v);
}

void CampaignParameters::visit(OptionVisitor& v) {
  v.text({"about", "One line that says what is special"}, about);
  settings.visit(v);
}

void Campaign::visit(OptionVisitor& v) {
  v.text({"title", "Title of the results"}, title);
  v.text({"about", "What the campaign asks"}, about);
  v.choice({"task", "localize, or sensors: how those of a log and of a simulated world err"}, task,
           {kTaskLocalize, kTaskSensors});
  v.text({"seeds", "Seeds of the localizer: 1..10 or 1,2,5"}, seeds);
  v.text({"recipes", "Recipes, separated by blanks; none: as configured"}, recipes);
  v.text({"baseline", "Variant that all others are compared with; none: the first"}, baseline);
  v.text({"metrics", "Columns of the printed tables, separated by blanks; none: error, drop rates, time"},
         metrics);
  v.number({"rpe_delta_m", "Path length over which relative errors are taken"}, rpe_delta_m, {1e-3, 1e6});
  v.number({"timeout_s", "Longest time for one cell"}, timeout_s, {1.0, kLongest_s});
  v.integer({"resamples", "Of the bootstrap"}, resamples, {100, 1'000'000});
  visit_table(v, {"inputs", "What is localized, by name"}, inputs);
  visit_table(v, {"parameters", "Sets of parameters, by name; none: one, as configured"}, parameters);
}

void Campaign::validate() {
  if (inputs.empty()) throw ConfigurationError("inputs", "is missing or empty", "name a log or a world");
  if (measures_sensors()) {
    check_sensor_campaign(*this);
  } else {
    for (const CampaignInput& input : inputs) check_input(input);
  }
  if (parameters.empty()) parameters.emplace_back().name = "default";
  for (const CampaignParameters& p : parameters) check_settings("parameters." + p.name, p.settings.set);
  const std::vector<CampaignCell> all = cells();
  const bool known = baseline.empty() || std::any_of(all.begin(), all.end(), [&](const CampaignCell& cell) {
                       return cell.variant == baseline;
                     });
  if (!known)
    throw ConfigurationError("baseline", "'" + baseline + "' is none of the variants", "name one of them");
}

std::vector<CampaignCell> Campaign::cells() const {
  const std::vector<std::uint64_t> all_seeds = parse_seeds("seeds", seeds);
  if (measures_sensors()) return sensor_cells(*this, all_seeds);
  std::vector<std::string> all_recipes = split_words(recipes);
  if (all_recipes.empty()) all_recipes.emplace_back();
  const std::size_t total = inputs.size() * all_recipes.size() * parameters.size() * all_seeds.size();
  if (total > kMostCells) {
    throw ConfigurationError("seeds", "make " + std::to_string(total) + " cells", "use at most 100000");
  }
  std::vector<CampaignCell> cells;
  cells.reserve(total);
  for (std::size_t input = 0; input < inputs.size(); ++input) {
    for (const std::string& recipe : all_recipes) {
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        const std::string variant = variant_name(*this, recipe, parameters[p].name, all_recipes.size());
        for (const std::uint64_t seed : all_seeds)
          cells.push_back({cells.size(), input, recipe, p, seed, variant});
      }
    }
  }
  return cells;
}

}  // namespace cairn
