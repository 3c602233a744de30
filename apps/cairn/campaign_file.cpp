#include "apps/cairn/campaign_file.hpp"

#include "apps/cairn/data_path.hpp"
#include "apps/cairn/key_place.hpp"
#include "apps/cairn/pose_option.hpp"
#include "apps/cairn/world_file.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

// Makes the path absolute or relative to the current folder, and refuses one that leads nowhere.
void resolve(const fs::path& folder, const std::string& key, std::string& path) {
  if (path.empty()) return;
  const fs::path found = folder / expand_data(key, path);
  if (!fs::is_regular_file(found)) {
    throw ConfigurationError(key, "there is no file " + found.string(),
                             "correct the path, or get the recording");
  }
  path = found.lexically_normal().string();
}

void resolve_input(const fs::path& folder, CampaignInput& input) {
  const std::string key = "inputs." + input.name;
  resolve(folder, key + ".log", input.log);
  resolve(folder, key + ".map", input.map);
  resolve(folder, key + ".reference", input.reference);
  resolve(folder, key + ".config", input.settings.config);
  if (!input.world.empty() && !is_built_in_world(input.world)) resolve(folder, key + ".world", input.world);
}

void check_start(const CampaignInput& input) {
  const std::string key = "inputs." + input.name;
  if (input.start != "reference" && input.start != "global") parse_pose(key + ".start", input.start);
  parse_pose(key + ".start_error", input.start_error);
}

// Applies the settings as the cell will: a slip is found before the first cell runs, and at its line.
void check_settings(const std::string& key, const CampaignSettings& settings, LocalizerOptions& options) {
  const VisitOptions visit = [&](OptionVisitor& v) { options.visit(v); };
  Diagnostics unused;
  if (!settings.config.empty()) {
    read_configuration(*open_input(settings.config), settings.config, visit, unused);
  }
  try {
    apply_settings(split_words(settings.set), visit);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(key, error.what(), "");
  }
}

void check_cell(const Campaign& campaign, const CampaignCell& cell) {
  const CampaignInput& input = campaign.inputs[cell.input];
  const CampaignParameters& parameters = campaign.parameters[cell.parameters];
  const std::string key = "parameters." + parameters.name;
  if (!input.settings.config.empty() && !parameters.settings.config.empty()) {
    throw ConfigurationError(key + ".config", "and inputs." + input.name + ".config exclude each other",
                             "keep one, and move the rest to `set`");
  }
  LocalizerOptions options;
  check_settings("inputs." + input.name + ".set", input.settings, options);
  if (!cell.recipe.empty()) check_settings("recipes", {"", "recipe=" + cell.recipe}, options);
  check_settings(key + ".set", parameters.settings, options);
  try {
    options.validate();
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(key, error.what(), "");
  }
}

std::string read_text(const fs::path& path) {
  const auto input = open_input(path, std::size_t{1} << 20);
  return {std::istreambuf_iterator<char>(*input), {}};
}

}  // namespace

CampaignFile read_campaign(const fs::path& path) {
  CampaignFile file{path, {}, {}};
  const std::string text = read_text(path);
  std::istringstream input(text);
  Diagnostics unused;
  read_configuration(
      input, path.string(), [&](OptionVisitor& v) { file.campaign.visit(v); }, unused);
  with_key_places(path.string(), text, [&] {
    file.campaign.validate();
    for (CampaignInput& in : file.campaign.inputs) {
      resolve_input(path.parent_path(), in);
      check_start(in);
    }
    for (CampaignParameters& p : file.campaign.parameters) {
      resolve(path.parent_path(), "parameters." + p.name + ".config", p.settings.config);
    }
    file.cells = file.campaign.cells();
    const std::uint64_t first_seed = file.cells.front().seed;
    for (const CampaignCell& cell : file.cells) {
      if (cell.seed == first_seed) check_cell(file.campaign, cell);
    }
  });
  return file;
}

CellSettings settings_of(const Campaign& campaign, const CampaignCell& cell) {
  const CampaignSettings& input = campaign.inputs[cell.input].settings;
  const CampaignSettings& parameters = campaign.parameters[cell.parameters].settings;
  CellSettings settings{input.config.empty() ? parameters.config : input.config, split_words(input.set)};
  if (!cell.recipe.empty()) settings.set.push_back("recipe=" + cell.recipe);
  for (std::string& word : split_words(parameters.set)) settings.set.push_back(std::move(word));
  return settings;
}

}  // namespace cairn::app
