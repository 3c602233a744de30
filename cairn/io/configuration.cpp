#include "cairn/io/configuration.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/amcl_parameters.hpp"
#include "cairn/io/option_suggestion.hpp"
#include "cairn/io/yaml_document.hpp"
#include "cairn/io/yaml_option_reader.hpp"

#include <algorithm>

#include <yaml-cpp/yaml.h>

namespace cairn {
namespace {

constexpr std::size_t kMostDots = 20;

// Dotted names of all options.
class OptionPaths final : public OptionVisitor {
 public:
  std::vector<std::string> paths;

  void number(const Field& field, double&, Range) override { add(field); }
  void integer(const Field& field, int&, Range) override { add(field); }
  void flag(const Field& field, bool&) override { add(field); }
  void choice(const Field& field, std::string&, const std::vector<std::string>&) override { add(field); }
  void text(const Field& field, std::string&) override { add(field); }
  void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) override {
    const std::string outer = prefix_;
    prefix_ += field.name + ".";
    visit(*this);
    prefix_ = outer;
  }
  void table(const Field&, const std::vector<std::string>&,
             const std::function<void(const std::string&, OptionVisitor&)>&) override {}

 private:
  void add(const Field& field) { paths.push_back(prefix_ + field.name); }
  std::string prefix_;
};

std::vector<std::string> paths_of(const VisitOptions& visit) {
  OptionPaths all;
  visit(all);
  return all.paths;
}

// {"filter.max_particles", "500"} -> {filter: {max_particles: 500}}
YAML::Node nested(const std::string& key, const std::string& value) {
  const std::size_t dot = key.find('.');
  YAML::Node node;
  if (dot == std::string::npos) {
    node[key] = load_yaml(value);
  } else {
    node[key.substr(0, dot)] = nested(key.substr(dot + 1), value);
  }
  return node;
}

YAML::Node parse_setting(const std::string& setting, const std::string& name) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigurationError(name, "is not key=value", "write for example filter.max_particles=500");
  }
  const std::string key = setting.substr(0, equals);
  if (static_cast<std::size_t>(std::count(key.begin(), key.end(), '.')) > kMostDots) {
    throw ConfigurationError(name, "has too many dots in its key", "see `cairn config` for the options");
  }
  return nested(key, setting.substr(equals + 1));
}

}  // namespace

void read_configuration(std::istream& input, const std::string& name, const VisitOptions& visit,
                        Diagnostics& diagnostics) {
  try {
    const YAML::Node root = load_yaml(input);
    if (root.IsNull()) return;
    if (is_amcl_parameter_file(root)) return read_amcl_parameters(root, name, visit, diagnostics);
    YamlOptionReader reader(root, {name, true, paths_of(visit)});
    visit(reader);
    reader.refuse_unknown_keys();
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(yaml_place(name, error.mark), "cannot be read as YAML: " + printable(error.msg),
                             "correct it");
  }
}

void apply_settings(const std::vector<std::string>& settings, const VisitOptions& visit) {
  for (const std::string& setting : settings) {
    const std::string name = "--set " + printable(setting);
    try {
      YamlOptionReader reader(parse_setting(setting, name), {name, false, paths_of(visit)});
      visit(reader);
      reader.refuse_unknown_keys();
    } catch (const YAML::Exception& error) {
      throw ConfigurationError(name, "cannot be read as YAML: " + printable(error.msg), "correct the value");
    }
  }
}

}  // namespace cairn
