#pragma once

#include "cairn/models/sensor/likelihood_field.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cairn::test {

using LaserModel = SensorModel<Pose2, LaserScan>;

/// A sensor model of laser scans, made with its default options.
struct LaserModelCase {
  std::string name;
  std::function<std::unique_ptr<const LaserModel>(const OccupancyGrid& map, const Pose2& T_base_sensor)> make;
};

/// Every sensor model of laser scans: one line each.
inline const std::vector<LaserModelCase> kLaserModels = {
    {"LikelihoodField",
     [](const OccupancyGrid& map, const Pose2& T_base_sensor) {
       const auto field = std::make_shared<const DistanceField>(map, LikelihoodFieldOptions{}.max_distance_m);
       return std::make_unique<const LikelihoodField>(field, T_base_sensor, BeamLimits{},
                                                      LikelihoodFieldOptions{});
     }},
};

}  // namespace cairn::test
