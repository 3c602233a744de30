#include "cairn/models/linearisations.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/models/derived_maps.hpp"

#include <algorithm>

namespace cairn {
namespace {

std::shared_ptr<const ScanMatching> make(DistanceToWall distance, const LaserModelParts& parts,
                                         double sigma_m, int max_beams, double effective_beams) {
  ScanMatchingOptions options;
  options.sigma_m = sigma_m;
  options.outlier_m = 2.0 * sigma_m;
  options.max_beams = max_beams;
  options.effective_beams = effective_beams;
  return std::make_shared<const ScanMatching>(std::move(distance), parts.T_base_sensor, parts.limits,
                                              options);
}

// Far enough for the gate.
double reach_m(const LaserModelParts& parts) {
  return std::max(ScanMatchingOptions{}.gate_m, parts.options.likelihood_field.max_distance_m);
}

std::shared_ptr<const ScanMatching> match_cells(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& o = parts.options.likelihood_field;
  return make(distance_to_cells(distance_field_of(parts.maps, reach_m(parts))), parts, o.sigma_hit_m,
              o.max_beams, o.effective_beams);
}

std::shared_ptr<const ScanMatching> match_walls(const LaserModelParts& parts) {
  const LikelihoodFieldOptions& o = parts.options.likelihood_field;
  return make(distance_to_walls(wall_distance_of(parts.maps, reach_m(parts))), parts, o.sigma_hit_m,
              o.max_beams, o.effective_beams);
}

std::shared_ptr<const ScanMatching> match_seen_walls(const LaserModelParts& parts) {
  const VectorLaserOptions& o = parts.options.vector_laser;
  return make(distance_to_walls(wall_distance_of(parts.maps, reach_m(parts))), parts, o.sigma_m, o.max_beams,
              o.effective_beams);
}

struct Entry {
  const char* model;
  std::shared_ptr<const ScanMatching> (*make)(const LaserModelParts& parts);
};
constexpr Entry kLinearisations[] = {{"likelihood_field_prob", match_cells},
                                     {"likelihood_field", match_cells},
                                     {"v_amcl", match_walls},
                                     {"vector_laser", match_seen_walls}};

}  // namespace

std::vector<std::string> linearised_laser_models() {
  std::vector<std::string> names;
  for (const Entry& entry : kLinearisations) names.emplace_back(entry.model);
  return names;
}

std::shared_ptr<const ScanMatching> make_laser_linearisation(const std::string& name,
                                                             const LaserModelParts& parts) {
  std::string known;
  for (const Entry& entry : kLinearisations) {
    if (name == entry.model) return entry.make(parts);
    known += (known.empty() ? "" : ", ") + std::string(entry.model);
  }
  throw ConfigurationError("laser.model", "'" + name + "' has no linearisation", "use one of " + known);
}

}  // namespace cairn
