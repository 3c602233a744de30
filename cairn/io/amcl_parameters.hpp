#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/io/configuration.hpp"

#include <string>

#include <yaml-cpp/yaml.h>

namespace cairn {

/// True for `amcl: {ros__parameters: ...}`, the parameter file of nav2's AMCL. Private to cairn/io.
bool is_amcl_parameter_file(const YAML::Node& root);

/// Takes over the parameters that have a counterpart, by name or alias; the others are counted in
/// `diagnostics` as "AMCL parameter without counterpart".
void read_amcl_parameters(const YAML::Node& root, const std::string& name, const VisitOptions& visit,
                          Diagnostics& diagnostics);

}  // namespace cairn
