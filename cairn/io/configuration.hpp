#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/options.hpp"

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace cairn {

/// Lets a visitor walk over some option structs: `[&](OptionVisitor& v) { options.visit(v); }`.
using VisitOptions = std::function<void(OptionVisitor&)>;

/// Sets options from a YAML file. What the file does not name keeps its value.
///
/// An unknown key is an error that names the nearest known one; so is a value of the wrong kind, NaN,
/// infinity, a value out of range, a key that stands twice, more than 1 MiB, more than 100 levels and a
/// second document. A parameter file of nav2's AMCL (`amcl: ros__parameters: ...`) is accepted as well: what
/// has a counterpart here is taken over, the rest is counted in `diagnostics`.
/// @param name of the file, for messages
/// @throws ConfigurationError "file:line:column: ..."
void read_configuration(std::istream& input, const std::string& name, const VisitOptions& visit,
                        Diagnostics& diagnostics);

/// Sets options from `key=value` texts, nested keys with dots: "filter.max_particles=500". Later ones win.
/// A stream whose name holds a dot can only be named in a file.
/// @throws ConfigurationError naming the text
void apply_settings(const std::vector<std::string>& settings, const VisitOptions& visit);

/// YAML text with every option, its value, and its documentation as a comment. Reading it back gives the same
/// values to the last bit.
std::string write_configuration(const VisitOptions& visit);

}  // namespace cairn
