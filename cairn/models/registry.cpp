#include "cairn/models/registry.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/models/derived_maps.hpp"
#include "cairn/models/sensor/amcl_likelihood_field.hpp"
#include "cairn/models/sensor/v_amcl.hpp"

#include <algorithm>

namespace cairn {
namespace {

// A distribution is felt in its own cell only: cells must be wider than the noise.
constexpr double kCellSigmas = 2.5;

struct LaserModelEntry {
  const char* name;
  std::shared_ptr<const LaserModel> (*make)(const LaserModelParts& parts);
};

std::shared_ptr<const LaserModel> make_likelihood_field_prob(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  return std::make_shared<const LikelihoodField>(distance_field_of(parts.maps, options.max_distance_m),
                                                 parts.T_base_sensor, parts.limits, options);
}

std::shared_ptr<const LaserModel> make_likelihood_field(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  return std::make_shared<const AmclLikelihoodField>(distance_field_of(parts.maps, options.max_distance_m),
                                                     parts.T_base_sensor, parts.limits, options);
}

std::shared_ptr<const LaserModel> make_beam(const LaserModelParts& parts) {
  return std::make_shared<const BeamModel>(ray_marcher_of(parts.maps, parts.limits.max_range_m),
                                           parts.T_base_sensor, parts.limits, parts.options.beam);
}

template <NdtKind Kind>
std::shared_ptr<const LaserModel> make_ndt_model(const LaserModelParts& parts) {
  const NdtModelOptions& options = parts.options.ndt;
  return std::make_shared<const NdtModel>(ndt_map_of(parts.maps, options.cell_size_m), Kind,
                                          parts.T_base_sensor, parts.limits, options);
}

std::shared_ptr<const LaserModel> make_vector_laser(const LaserModelParts& parts) {
  return std::make_shared<const VectorLaser>(wall_grid_of(parts.maps), parts.T_base_sensor, parts.limits,
                                             parts.options.vector_laser);
}

std::shared_ptr<const LaserModel> make_v_amcl(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& options = parts.options.likelihood_field;
  return std::make_shared<const VectorAmcl>(wall_distance_of(parts.maps, options.max_distance_m),
                                            parts.T_base_sensor, parts.limits, options);
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
  v.section({"beam_skip", "every model: leave out the beams that fit the map nowhere in the belief"},
            [this](OptionVisitor& inner) { beam_skip.visit(inner); });
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
