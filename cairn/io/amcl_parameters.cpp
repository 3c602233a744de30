#include "cairn/io/amcl_parameters.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/yaml_option_reader.hpp"

#include <set>

namespace cairn {
namespace {

// AMCL's parameters are one flat list: every field of every section looks itself up there, by name and
// aliases.
class AmclReader final : public OptionVisitor {
 public:
  AmclReader(const YAML::Node& parameters, std::string name)
      : parameters_(parameters), name_(std::move(name)) {}

  void number(const Field& field, double& value, Range range) override {
    read(field, [&](YamlOptionReader& reader, const Field& found) { reader.number(found, value, range); });
  }
  void integer(const Field& field, int& value, Range range) override {
    read(field, [&](YamlOptionReader& reader, const Field& found) { reader.integer(found, value, range); });
  }
  void flag(const Field& field, bool& value) override {
    read(field, [&](YamlOptionReader& reader, const Field& found) { reader.flag(found, value); });
  }
  void choice(const Field& field, std::string& value, const std::vector<std::string>& choices) override {
    read(field, [&](YamlOptionReader& reader, const Field& found) { reader.choice(found, value, choices); });
  }
  void text(const Field&, std::string&) override {}
  void section(const Field&, const std::function<void(OptionVisitor&)>& visit) override { visit(*this); }
  void table(const Field&, const std::vector<std::string>&,
             const std::function<void(const std::string&, OptionVisitor&)>&) override {}

  const std::set<std::string>& taken() const { return taken_; }

 private:
  template <class Read>
  void read(const Field& field, const Read& read_from) {
    std::vector<std::string> names = field.aliases;
    names.push_back(field.name);
    for (const std::string& key : names) {
      const YAML::Node& constant = parameters_;
      if (!constant[key]) continue;
      YamlOptionReader reader(parameters_, {name_});
      read_from(reader, {key, field.documentation});
      taken_.insert(key);
    }
  }

  YAML::Node parameters_;
  std::string name_;
  std::set<std::string> taken_;
};

}  // namespace

bool is_amcl_parameter_file(const YAML::Node& root) {
  return root.IsMap() && root["amcl"] && root["amcl"].IsMap() && root["amcl"]["ros__parameters"] &&
         root["amcl"]["ros__parameters"].IsMap();
}

void read_amcl_parameters(const YAML::Node& root, const std::string& name, const VisitOptions& visit,
                          Diagnostics& diagnostics) {
  const YAML::Node parameters = root["amcl"]["ros__parameters"];
  refuse_duplicate_keys(parameters, {name});
  AmclReader reader(parameters, name);
  visit(reader);
  for (const auto& entry : parameters) {
    const std::string& key = entry.first.Scalar();
    if (reader.taken().contains(key)) continue;
    diagnostics.warn("AMCL parameter without counterpart", yaml_place(name, entry.first.Mark()), key);
  }
}

}  // namespace cairn
