#include "cairn/io/configuration.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/amcl_parameters.hpp"
#include "cairn/io/yaml_option_reader.hpp"

#include <sstream>

#include <yaml-cpp/yaml.h>

namespace cairn {
namespace {

// {"filter.max_particles", "500"} -> {filter: {max_particles: 500}}
YAML::Node nested(const std::string& key, const std::string& value) {
  const std::size_t dot = key.find('.');
  YAML::Node node;
  if (dot == std::string::npos) {
    node[key] = YAML::Load(value);
  } else {
    node[key.substr(0, dot)] = nested(key.substr(dot + 1), value);
  }
  return node;
}

YAML::Node parse_setting(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigurationError("--set " + setting, "is not key=value",
                             "write for example filter.max_particles=500");
  }
  try {
    return nested(setting.substr(0, equals), setting.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw ConfigurationError("--set " + setting, error.msg, "correct the value");
  }
}

}  // namespace

void read_configuration(std::istream& input, const std::string& name, const VisitOptions& visit,
                        Diagnostics& diagnostics) {
  try {
    const YAML::Node root = YAML::Load(input);
    if (root.IsNull()) return;
    if (is_amcl_parameter_file(root)) return read_amcl_parameters(root, name, visit, diagnostics);
    YamlOptionReader reader(root, name);
    visit(reader);
    reader.refuse_unknown_keys();
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(yaml_place(name, error.mark), error.msg, "correct the YAML");
  }
}

void apply_settings(const std::vector<std::string>& settings, const VisitOptions& visit) {
  for (const std::string& setting : settings) {
    try {
      YamlOptionReader reader(parse_setting(setting), "--set " + setting);
      visit(reader);
      reader.refuse_unknown_keys();
    } catch (const YAML::Exception& error) {
      throw ConfigurationError("--set " + setting, error.msg, "correct the value");
    }
  }
}

}  // namespace cairn
