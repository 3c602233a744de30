#pragma once

#include "cairn/models/registry.hpp"
#include "cairn/models/sensor/scan_matching.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// Names of the sensor models of laser scans that Kalman filters can use: likelihood_field_prob,
/// likelihood_field, v_amcl, vector_laser.
std::vector<std::string> linearised_laser_models();

/// A model's linearisation, with the noise and the beams that its options tell; the maps that it needs are
/// derived from those at hand.
/// @throws ConfigurationError for a model that has none (the sentence names those that do), or if the maps at
/// hand do not do
std::shared_ptr<const ScanMatching> make_laser_linearisation(const std::string& name,
                                                             const LaserModelParts& parts);

}  // namespace cairn
