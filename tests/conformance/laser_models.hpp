#pragma once

#include "cairn/models/registry.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn::test {

/// A sensor model of laser scans, made with its default options.
struct LaserModelCase {
  std::string name;
  double margin_nat;       ///< by which the truth scores above poses 0.2 m or 0.15 rad away
  bool gradient_is_exact;  ///< if it has one: the derivative of the score itself, all things varied
  std::shared_ptr<const LaserModel> make(const OccupancyGrid& map, const Pose2& T_base_sensor) const {
    const MapSet maps(std::make_shared<const OccupancyGrid>(map));
    return make_laser_model(name, {maps, T_base_sensor, BeamLimits{}, LaserModelOptions{}});
  }
};

// By construction AMCL's sum hardly tells poses apart.
inline double margin_nat(const std::string& model) { return model == "likelihood_field" ? 0.1 : 1.0; }

// Corrective gradient refinement keeps the correspondences fixed; that of the likelihood field is
// interpolated.
inline bool gradient_is_exact(const std::string& model) { return model == "ndt" || model == "ondt"; }

/// Every sensor model of laser scans in the registry.
inline std::vector<LaserModelCase> laser_models() {
  std::vector<LaserModelCase> cases;
  for (const std::string& name : laser_model_names())
    cases.push_back({name, margin_nat(name), gradient_is_exact(name)});
  return cases;
}

}  // namespace cairn::test
