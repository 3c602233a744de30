#include "cairn/io/yaml_key_place.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const char* const kText = "a: 1\ninputs:\n  office.v2:\n    log: x\n  other:\n    log: y\n";

TEST(YamlKeyPlace, NamesLineAndColumn) {
  EXPECT_EQ(yaml_key_place(kText, "f.yaml", "a"), "f.yaml:1:1: a");
  EXPECT_EQ(yaml_key_place(kText, "f.yaml", "inputs.other.log"), "f.yaml:6:5: inputs.other.log");
}

TEST(YamlKeyPlace, NamesWithDots) {
  EXPECT_EQ(yaml_key_place(kText, "f.yaml", "inputs.office.v2.log"), "f.yaml:4:5: inputs.office.v2.log");
}

TEST(YamlKeyPlace, AMissingKeyHasThePlaceOfItsGroup) {
  EXPECT_EQ(yaml_key_place(kText, "f.yaml", "inputs.other.map"), "f.yaml:5:3: inputs.other.map");
  EXPECT_EQ(yaml_key_place(kText, "f.yaml", "seeds"), "f.yaml: seeds");
}

TEST(YamlKeyPlace, NoYamlIsNoProblem) {
  EXPECT_EQ(yaml_key_place("{", "f.yaml", "a"), "f.yaml: a");
  EXPECT_EQ(yaml_key_place("", "f.yaml", "a"), "f.yaml: a");
  EXPECT_EQ(yaml_key_place("- a", "f.yaml", "a"), "f.yaml: a");
}

}  // namespace
}  // namespace cairn
