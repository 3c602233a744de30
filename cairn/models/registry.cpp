#include "cairn/models/registry.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/amcl_likelihood_field.hpp"

#include <algorithm>

namespace cairn {
namespace {

struct LaserModelEntry {
  const char* name;
  std::shared_ptr<const LaserModel> (*make)(const LaserModelParts& parts);
};

std::shared_ptr<const DistanceField> distance_field(const MapSet& maps, double max_distance_m) {
  return maps.derive<DistanceField>(std::to_string(max_distance_m), [&] {
    return std::make_shared<const DistanceField>(*maps.grid(), max_distance_m);
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

// The one table of names: a new sensor model of laser scans is one line here.
constexpr LaserModelEntry kLaserModels[] = {
    {"likelihood_field_prob", make_likelihood_field_prob},
    {"likelihood_field", make_likelihood_field},
};

}  // namespace

void LaserModelOptions::visit(OptionVisitor& v) {
  v.choice({"model", "sensor model of the streams that name none", {"laser_model_type"}}, model,
           laser_model_names());
  likelihood_field.visit(v);
}

void LaserModelOptions::validate() const {
  if (likelihood_field.z_hit + likelihood_field.z_rand <= 0.0) {
    throw ConfigurationError("laser.z_hit", "and z_rand are both zero", "give one of them a weight");
  }
}

LaserModelOptions widened(LaserModelOptions options, double sigma_hit_m, double effective_beams) {
  options.likelihood_field.sigma_hit_m = sigma_hit_m;
  options.likelihood_field.effective_beams = effective_beams;
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
