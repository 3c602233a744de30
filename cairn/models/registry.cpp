#include "cairn/models/registry.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/maps/wall_extraction.hpp"
#include "cairn/models/sensor/amcl_likelihood_field.hpp"
#include "cairn/models/sensor/v_amcl.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// A distribution is felt in its own cell only: cells must be wider than the noise.
constexpr double kCellSigmas = 2.5;

struct LaserModelEntry {
  const char* name;
  std::shared_ptr<const LaserModel> (*make)(const LaserModelParts& parts);
};

std::shared_ptr<const DistanceField> distance_field(const MapSet& maps, double max_distance_m) {
  return maps.derive<DistanceField>(std::to_string(max_distance_m), [&] {
    return std::make_shared<const DistanceField>(*maps.grid(), max_distance_m);
  });
}

// The map that was given, else the walls of the grid.
std::shared_ptr<const NdtMap> ndt_map(const MapSet& maps, double cell_size_m) {
  if (auto given = maps.find<NdtMap>()) return given;
  return maps.derive<NdtMap>(std::to_string(cell_size_m), [&] {
    return std::make_shared<const NdtMap>(ndt_from_grid(*maps.grid(), {.cell_size_m = cell_size_m}));
  });
}

std::shared_ptr<const LaserModel> make_likelihood_field_prob(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  return std::make_shared<const LikelihoodField>(distance_field(parts.maps, options.max_distance_m),
                                                 parts.T_base_sensor, parts.limits, options);
}

std::shared_ptr<const LaserModel> make_likelihood_field(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  return std::make_shared<const AmclLikelihoodField>(distance_field(parts.maps, options.max_distance_m),
                                                     parts.T_base_sensor, parts.limits, options);
}

// Nothing within reach of the scanner or inside the map is further away than this.
double longest_ray_m(const GridGeometry& grid, const BeamLimits& limits) {
  return std::min(limits.max_range_m, std::hypot(grid.width, grid.height) * grid.resolution_m);
}

std::shared_ptr<const LaserModel> make_beam(const LaserModelParts& parts) {
  const auto grid = parts.maps.grid();
  const double longest_m = longest_ray_m(grid->geometry(), parts.limits);
  const auto marcher = parts.maps.derive<RayMarcher>(
      std::to_string(longest_m), [&] { return std::make_shared<const RayMarcher>(*grid, longest_m); });
  return std::make_shared<const BeamModel>(marcher, parts.T_base_sensor, parts.limits, parts.options.beam);
}

template <NdtKind Kind>
std::shared_ptr<const LaserModel> make_ndt_model(const LaserModelParts& parts) {
  const NdtModelOptions& options = parts.options.ndt;
  return std::make_shared<const NdtModel>(ndt_map(parts.maps, options.cell_size_m), Kind, parts.T_base_sensor,
                                          parts.limits, options);
}

// The vector map that was given, or the straight walls of the grid.
std::shared_ptr<const VectorMap> vector_map(const MapSet& maps) {
  if (auto given = maps.find<VectorMap>()) return given;
  return maps.derive<VectorMap>(
      "grid", [&] { return std::make_shared<const VectorMap>(extract_walls(*maps.grid())); });
}

std::shared_ptr<const LaserModel> make_vector_laser(const LaserModelParts& parts) {
  const auto walls = parts.maps.derive<WallGrid>(
      "laser", [&] { return std::make_shared<const WallGrid>(vector_map(parts.maps), kSeenByLaser); });
  return std::make_shared<const VectorLaser>(walls, parts.T_base_sensor, parts.limits,
                                             parts.options.vector_laser);
}

std::shared_ptr<const LaserModel> make_v_amcl(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  const auto walls = parts.maps.derive<WallDistance>(std::to_string(options.max_distance_m), [&] {
    return std::make_shared<const WallDistance>(vector_map(parts.maps), options.max_distance_m, kSeenByLaser);
  });
  return std::make_shared<const VectorAmcl>(walls, parts.T_base_sensor, parts.limits, options);
}

// The one table of names: a new sensor model of laser scans is one line here.
constexpr LaserModelEntry kLaserModels[] = {
    {"likelihood_field_prob", make_likelihood_field_prob},
    {"likelihood_field", make_likelihood_field},
    {"beam", make_beam},
    {"ndt", make_ndt_model<NdtKind::kNdt>},
    {"ondt", make_ndt_model<NdtKind::kOndt>},
    {"vector_laser", make_vector_laser},
    {"v_amcl", make_v_amcl},
};

}  // namespace

void LaserModelOptions::visit(OptionVisitor& v) {
  v.choice({"model", "sensor model of the streams that name none", {"laser_model_type"}}, model,
           laser_model_names());
  likelihood_field.visit(v);
  v.section({"beam", "model beam: mixture on the range that the map predicts"},
            [this](OptionVisitor& inner) { beam.visit(inner); });
  v.section({"ndt", "models ndt and ondt: normal distributions of the walls"},
            [this](OptionVisitor& inner) { ndt.visit(inner); });
  v.section({"vector_laser", "model vector_laser: distance to the wall that is seen in the beam's direction"},
            [this](OptionVisitor& inner) { vector_laser.visit(inner); });
}

void LaserModelOptions::validate() const {
  if (likelihood_field.z_hit + likelihood_field.z_rand <= 0.0) {
    throw ConfigurationError("laser.z_hit", "and z_rand are both zero", "give one of them a weight");
  }
}

LaserModelOptions with_effective_beams(LaserModelOptions options, double effective_beams) {
  options.likelihood_field.effective_beams = effective_beams;
  options.beam.effective_beams = effective_beams;
  options.ndt.effective_beams = effective_beams;
  options.vector_laser.effective_beams = effective_beams;
  return options;
}

LaserModelOptions widened(const LaserModelOptions& narrow, double sigma_hit_m, double effective_beams) {
  LaserModelOptions options = with_effective_beams(narrow, effective_beams);
  options.likelihood_field.sigma_hit_m = sigma_hit_m;
  options.beam.sigma_hit_m = sigma_hit_m;
  options.ndt.sigma_hit_m = sigma_hit_m;
  options.ndt.cell_size_m = std::max(options.ndt.cell_size_m, kCellSigmas * sigma_hit_m);
  options.vector_laser.sigma_m = sigma_hit_m;
  return options;
}

std::vector<std::string> laser_model_names() {
  std::vector<std::string> names;
  for (const LaserModelEntry& entry : kLaserModels) names.emplace_back(entry.name);
  return names;
}

std::shared_ptr<const LaserModel> make_laser_model(const std::string& name, const LaserModelParts& parts) {
  const auto* found = std::find_if(std::begin(kLaserModels), std::end(kLaserModels),
                                   [&](const LaserModelEntry& entry) { return entry.name == name; });
  if (found != std::end(kLaserModels)) return found->make(parts);
  std::string known;
  for (const std::string& each : laser_model_names()) known += (known.empty() ? "" : ", ") + each;
  throw ConfigurationError("laser.model", "'" + name + "' is not known", "use one of " + known);
}

}  // namespace cairn
