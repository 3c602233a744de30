#pragma once

#include "cairn/core/options.hpp"
#include "cairn/eval/bootstrap.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cairn {

/// Settings by a configuration file and `key=value` texts separated by blanks, over those of the input.
struct CampaignSettings {
  std::string config;  ///< file; may be empty
  std::string set;     ///< "filter.particles=500 update.min_translation_m=0.2"

  void visit(OptionVisitor& visitor);
};

/// What is localized: a recording with its map, or a world to simulate.
struct CampaignInput {
  std::string name;
  std::string log;
  std::string map;
  std::string reference;
  std::string world;                ///< built-in name or file; excludes log, map and reference
  std::string world_set;            ///< key=value texts for `cairn simulate --set`
  std::string world_seed = "each";  ///< a number, or "each": the seed of the cell
  double duration_s = 0.0;          ///< of the simulation; 0: as the world says
  std::string start = "reference";  ///< "reference", "global", or x,y,yaw (m, rad)
  std::string start_error = "0,0,0";
  bool live = false;  ///< messages in the order of arrival
  // Of task sensors: how the log is read.
  std::string stream;                     ///< laser, where the log has several
  std::string odometry;                   ///< stream; empty: the first
  std::string trajectory_frame = "base";  ///< whose poses the reference holds: base or sensor
  double max_gap_s = 1.0;                 ///< the reference is not interpolated between poses further apart
  CampaignSettings settings;

  void visit(OptionVisitor& visitor);
};

struct CampaignParameters {
  std::string name;
  std::string about;  ///< one line for the tables
  CampaignSettings settings;

  void visit(OptionVisitor& visitor);
};

/// What the cells of a campaign do.
inline constexpr const char* kTaskLocalize = "localize";  ///< run the localizer, and judge it
inline constexpr const char* kTaskSensors =
    "sensors";  ///< measure how the sensors err, in the log and in the world

/// The two variants of task sensors.
inline constexpr const char* kVariantReal = "real";
inline constexpr const char* kVariantSimulated = "simulated";

/// One run of the localizer: one input, one recipe, one set of parameters, one seed.
struct CampaignCell {
  std::size_t index = 0;
  std::size_t input = 0;       ///< of Campaign::inputs
  std::string recipe;          ///< empty: as configured
  std::size_t parameters = 0;  ///< of Campaign::parameters
  std::uint64_t seed = 0;
  std::string variant;  ///< recipe and parameters in one name, without what does not vary
};

/// An experiment: every input with every recipe, every set of parameters and every seed.
struct Campaign {
  static constexpr std::size_t kMostCells = 100'000;

  std::string title;
  std::string about;
  /// "localize"; or "sensors": every input names a log with map and reference and a world of the same drive;
  /// the log is measured once, the world is simulated with each seed.
  std::string task = kTaskLocalize;
  std::string seeds = "1..10";  ///< "1..10", or "1,2,5"
  std::string recipes;          ///< "mcl kld_mcl"; empty: as configured
  std::string baseline;         ///< variant that the others are compared with; empty: the first
  std::string metrics;          ///< columns of the printed tables; empty: error, drop rates and time
  double rpe_delta_m = 1.0;     ///< path length over which relative errors are taken
  double timeout_s = 3600.0;    ///< of one cell
  int resamples = 10'000;       ///< of the bootstrap
  std::vector<CampaignInput> inputs;
  std::vector<CampaignParameters> parameters;  ///< at least one after validate(): "default"

  void visit(OptionVisitor& visitor);

  /// @throws ConfigurationError whose where() is the dotted name of the option ("inputs.office.log")
  void validate();

  /// All cells: inputs outermost, then recipes, parameters, seeds. The same campaign gives the same list.
  /// @throws ConfigurationError as validate() for seeds that are no list, and beyond kMostCells
  std::vector<CampaignCell> cells() const;

  bool measures_sensors() const { return task == kTaskSensors; }
  BootstrapOptions bootstrap() const { return {.resamples = resamples, .level = 0.95, .seed = 1}; }
};

/// "1..3" and "1,2,3" -> {1, 2, 3}. Seeds may not repeat.
/// @throws ConfigurationError with where() = `key`
std::vector<std::uint64_t> parse_seeds(const std::string& key, const std::string& text);

/// The parts of a text between blanks.
std::vector<std::string> split_words(const std::string& text);

}  // namespace cairn
