#include "apps/cairn/map_ambiguity.hpp"

#include "apps/cairn/ambiguity_picture.hpp"
#include "apps/cairn/output_file.hpp"
#include "apps/cairn/progress.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
constexpr int kProgressSteps = 1000;
constexpr const char* kSensorForm = "write DEGREES,METRES[,BEAMS], for example 180,30 or 270,10,60";

struct Arguments {
  std::string map;
  std::string sensor = "180,30,60";
  std::string config;
  std::vector<std::string> settings;
  std::string out;
  double spacing_m = 0.5;
  int threads = 1;
  bool json = false;
  SelfSimilarityOptions options;
};

struct Sensor {
  double view_rad = kPi;
  double range_m = 30.0;
  int beams = 60;
};

Sensor parse_sensor(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value))
      throw ConfigurationError("--sensor", "'" + text + "' is no sensor", kSensorForm);
    numbers.push_back(value);
    if (next == end) break;
    if (*next != ',') throw ConfigurationError("--sensor", "'" + text + "' is no sensor", kSensorForm);
    at = next + 1;
  }
  const bool beams_given = numbers.size() == 3;
  const double beams = beams_given ? numbers[2] : 60.0;
  if (numbers.size() < 2 || numbers.size() > 3 || !(numbers[0] > 0.0 && numbers[0] <= 360.0) ||
      !(numbers[1] > 0.0 && numbers[1] <= 1000.0) || !(beams >= 3.0 && beams <= 10000.0) ||
      beams != std::floor(beams))
    throw ConfigurationError("--sensor", "'" + text + "' is no sensor", kSensorForm);
  return {degrees_to_radians(numbers[0]), numbers[1], static_cast<int>(beams)};
}

/// What is written and printed.
struct Certificate {
  const OccupancyGrid& map;
  const Arguments& arguments;
  Sensor sensor;
  double spacing_m;
  std::vector<SelfSimilarPlace> places;

  double share(const std::function<bool(const SelfSimilarPlace&)>& is) const {
    return static_cast<double>(std::count_if(places.begin(), places.end(), is)) /
           static_cast<double>(places.size());
  }
  double ambiguous_share() const {
    return share([](const SelfSimilarPlace& p) { return !p.alternatives.empty(); });
  }
  double unresolved_share() const {
    return share([](const SelfSimilarPlace& p) {
      return !p.alternatives.empty() && !std::isfinite(p.resolved_after_m);
    });
  }
  /// Of the places that are ambiguous and can be resolved; 0 if there are none.
  double median_drive_m() const {
    std::vector<double> drives;
    for (const SelfSimilarPlace& p : places) {
      if (!p.alternatives.empty() && std::isfinite(p.resolved_after_m)) drives.push_back(p.resolved_after_m);
    }
    if (drives.empty()) return 0.0;
    std::nth_element(drives.begin(), drives.begin() + static_cast<std::ptrdiff_t>(drives.size() / 2),
                     drives.end());
    return drives[drives.size() / 2];
  }
};

std::vector<std::string> as_lines(const Certificate& c) {
  return {fmt::format("sensor      {:.0f} degrees, {:.1f} m, {} beams", radians_to_degrees(c.sensor.view_rad),
                      c.sensor.range_m, c.sensor.beams),
          fmt::format("looked at   {} places, {:.2f} m apart, in {} headings each", c.places.size(),
                      c.spacing_m, c.arguments.options.headings),
          fmt::format("ambiguous   {:.1f} % of the places: another pose explains what is seen there within a "
                      "factor of {:.0f}",
                      100 * c.ambiguous_share(), std::exp(c.arguments.options.margin)),
          fmt::format("to resolve  {:.1f} m of driving (median); {:.1f} % of all places not within {:.0f} m",
                      c.median_drive_m(), 100 * c.unresolved_share(), c.arguments.options.farthest_drive_m)};
}

Json pose_json(const Pose2& pose) { return {{"x_m", pose.x}, {"y_m", pose.y}, {"yaw_rad", pose.theta}}; }

Json as_json(const Certificate& c) {
  Json json = {
      {"map", c.arguments.map},
      {"sensor", {{"view_rad", c.sensor.view_rad}, {"range_m", c.sensor.range_m}, {"beams", c.sensor.beams}}},
      {"spacing_m", c.spacing_m},
      {"headings", c.arguments.options.headings},
      {"apart_m", c.arguments.options.apart_m},
      {"apart_rad", c.arguments.options.apart_rad},
      {"margin", c.arguments.options.margin},
      {"farthest_drive_m", c.arguments.options.farthest_drive_m},
      {"looked_at", c.places.size()},
      {"ambiguous_share", c.ambiguous_share()},
      {"unresolved_share", c.unresolved_share()},
      {"median_drive_m", c.median_drive_m()},
      {"ambiguous", Json::array()}};
  for (const SelfSimilarPlace& place : c.places) {
    if (place.alternatives.empty()) continue;
    Json row = pose_json(place.T_map_sensor);
    row["ambiguous_headings"] = place.ambiguous_headings;
    row["resolved_after_m"] =
        std::isfinite(place.resolved_after_m) ? Json(place.resolved_after_m) : Json(nullptr);
    row["alternatives"] = Json::array();
    for (const Alternative& a : place.alternatives) {
      Json other = pose_json(a.T_map_sensor);
      other["log_ratio"] = a.log_ratio;
      row["alternatives"].push_back(other);
    }
    json["ambiguous"].push_back(row);
  }
  return json;
}

void write_files(const Certificate& c) {
  const fs::path folder = c.arguments.out;
  const AmbiguityView view{c.map, c.places, c.spacing_m, c.arguments.options.farthest_drive_m};
  write_file(folder / "ambiguity.json", as_json(c).dump(1) + "\n");
  write_file(folder / "ambiguity.svg", ambiguity_svg(view));
  write_file(folder / "ambiguity.html", ambiguity_page(view, "Where the map is ambiguous", as_lines(c)));
}

void check_arguments(const Arguments& a) {
  parse_sensor(a.sensor);
  a.options.validate();
  if (!(a.spacing_m >= 0.05 && a.spacing_m <= 100.0))
    throw ConfigurationError("--spacing", "is out of range", "give 0.05 to 100 m");
  if (a.threads < 1 || a.threads > Executor::kMostThreads)
    throw ConfigurationError("--threads", "is " + std::to_string(a.threads),
                             "use 1 to " + std::to_string(Executor::kMostThreads));
  if (!a.out.empty()) prepare_output_folder(a.out);
}

LikelihoodFieldOptions read_model(const Arguments& arguments) {
  LocalizerOptions options;
  Diagnostics diagnostics;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  if (!arguments.config.empty())
    read_configuration(*open_input(arguments.config), arguments.config, visit, diagnostics);
  apply_settings(arguments.settings, visit);
  options.validate();
  return options.laser.likelihood_field;
}

Certificate examine(const Arguments& arguments, const LikelihoodFieldOptions& model,
                    const OccupancyGrid& map) {
  const Sensor sensor = parse_sensor(arguments.sensor);
  SelfSimilarityOptions options = arguments.options;
  options.beams = sensor.beams;
  constexpr double kIndexShare = 0.1;
  Progress progress("comparing places", kProgressSteps);
  const auto tell = [&](double done) { progress.update(static_cast<std::int64_t>(kProgressSteps * done)); };
  const PlaceIndex index(map,
                         {.first_bearing_rad = -0.5 * sensor.view_rad,
                          .last_bearing_rad = 0.5 * sensor.view_rad,
                          .max_range_m = std::min(sensor.range_m, SignatureShape{}.max_range_m)},
                         {.spacing_m = arguments.spacing_m}, [&](double done) { tell(kIndexShare * done); });
  const Executor executor(arguments.threads);
  return {map, arguments, sensor, index.spacing_m(),
          find_self_similarity(map, index, model, sensor.range_m, options, executor,
                               [&](double done) { tell(kIndexShare + (1.0 - kIndexShare) * done); })};
}

int run_ambiguity(const Arguments& arguments) {
  check_arguments(arguments);
  const LikelihoodFieldOptions model = read_model(arguments);
  Diagnostics diagnostics;
  const auto map = read_map(arguments.map, diagnostics);
  for (const auto& [kind, count] : diagnostics.counts())
    spdlog::warn("{}: {} ({} times)", arguments.map, kind, count);
  const Certificate certificate = examine(arguments, model, *map);
  if (arguments.json) {
    std::cout << as_json(certificate).dump(2) << "\n";
  } else {
    for (const std::string& line : as_lines(certificate)) std::cout << line << "\n";
  }
  if (!arguments.out.empty()) {
    write_files(certificate);
    if (!arguments.json) std::cout << "written to " << arguments.out << "\n";
  }
  return kOk;
}

}  // namespace

void add_map_ambiguity(CLI::App& parent, Runner& run) {
  auto* command = parent.add_subcommand(
      "ambiguity", "Where a map looks alike to a laser scanner, and how far to drive to tell");
  auto a = std::make_shared<Arguments>();
  command->add_option("--map", a->map, "Map (map_server YAML, Wean)")->required();
  command->add_option("--sensor", a->sensor, "Field of view (degrees), range (m) and beams of the scanner")
      ->capture_default_str();
  command->add_option("--config", a->config, "Configuration: the noise of the model (laser.*)");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  command->add_option("--out", a->out, "Folder for ambiguity.json, ambiguity.svg and ambiguity.html");
  command->add_option("--spacing", a->spacing_m, "Between the places looked at, m")->capture_default_str();
  command->add_option("--headings", a->options.headings, "Headings looked in per place")
      ->capture_default_str();
  command
      ->add_option("--apart", a->options.apart_m,
                   "Another pose is at least this far away, m, or turned by 45 degrees")
      ->capture_default_str();
  command
      ->add_option("--margin", a->options.margin,
                   "It explains about as well if its log-likelihood is at most this much lower")
      ->capture_default_str();
  command
      ->add_option("--drive", a->options.farthest_drive_m,
                   "Look for drives that tell places apart up to this length, m")
      ->capture_default_str();
  command->add_option("--threads", a->threads, "Changes the time taken, never the results")
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print JSON (m, rad)");
  command->footer("Poses are of the scanner.");
  command->callback([a, &run] { run = [a] { return run_ambiguity(*a); }; });
}

}  // namespace cairn::app
