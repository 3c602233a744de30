#include "cairn/io/yaml_document.hpp"

#include <sstream>

#include <yaml-cpp/eventhandler.h>

namespace cairn {
namespace {

// Looks at a document without building it. Building and destroying a node recurse, so the depth must be known
// to be small before.
class DepthCheck final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void enter(const YAML::Mark& mark) {
    if (++depth_ > kMaxYamlDepth) {
      throw YAML::ParserException(mark, "is nested more than " + std::to_string(kMaxYamlDepth) + " deep");
    }
  }

  int depth_ = 0;
};

void check(const std::string& text) {
  if (text.size() > kMaxYamlBytes) {
    throw YAML::ParserException(YAML::Mark::null_mark(),
                                "holds more than " + std::to_string(kMaxYamlBytes) + " bytes");
  }
  std::istringstream input(text);
  YAML::Parser parser(input);
  DepthCheck depth;
  if (!parser.HandleNextDocument(depth)) return;
  if (parser.HandleNextDocument(depth)) {
    throw YAML::ParserException(YAML::Mark::null_mark(), "holds more than one YAML document");
  }
}

}  // namespace

YAML::Node load_yaml(const std::string& text) {
  check(text);
  return YAML::Load(text);
}

YAML::Node load_yaml(std::istream& input) {
  std::string text(kMaxYamlBytes + 1, '\0');
  input.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(input.gcount()));
  return load_yaml(text);
}

}  // namespace cairn
