#pragma once

#include "cairn/bayes/resampling/resampling.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// The names of all resampling schemes.
const std::vector<std::string>& resampling_schemes();

/// @throws ConfigurationError for a name that is not among them
std::unique_ptr<Resampling> make_resampling(const std::string& name);

}  // namespace cairn
