#include "cairn/io/yaml_document.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    load_yaml(text);
  } catch (const YAML::Exception& error) {
    return error.what();
  }
  return "accepted";
}

std::string repeat(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(YamlDocument, ReadsOneDocument) {
  EXPECT_EQ(load_yaml("a: 1")["a"].as<int>(), 1);
  EXPECT_EQ(load_yaml("---\na: 1\n...\n")["a"].as<int>(), 1);
  EXPECT_TRUE(load_yaml("").IsNull());
  EXPECT_TRUE(load_yaml("# nothing but words\n").IsNull());
  std::istringstream input("b: 2");
  EXPECT_EQ(load_yaml(input)["b"].as<int>(), 2);
}

TEST(YamlDocument, TakesMarksOfOtherSystems) {
  EXPECT_EQ(load_yaml("a: 1\r\nb: 2\r\n")["b"].as<int>(), 2);
  EXPECT_EQ(load_yaml("\xEF\xBB\xBF"
                      "a: 1\n")["a"]
                .as<int>(),
            1);
}

TEST(YamlDocument, RefusesASecondDocument) {
  EXPECT_THAT(refusal("a: 1\n---\nb: 2\n"), HasSubstr("more than one"));
}

TEST(YamlDocument, RefusesDepth) {
  EXPECT_EQ(refusal(repeat("[", 100) + repeat("]", 100)), "accepted");
  EXPECT_THAT(refusal(repeat("[", 101) + repeat("]", 101)), HasSubstr("nested more than 100 deep"));
  for (const char* opening : {"[", "{", "- ", "? ", "[{", "{a: "}) {
    EXPECT_NE(refusal(repeat(opening, 100'000)), "accepted") << opening;
  }
  std::string block;
  for (int i = 0; i < 500; ++i) block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_THAT(refusal(block), HasSubstr("nested more than 100 deep"));
}

TEST(YamlDocument, RefusesSize) {
  EXPECT_EQ(refusal("#" + std::string(kMaxYamlBytes - 1, 'x')), "accepted");
  EXPECT_THAT(refusal("#" + std::string(kMaxYamlBytes, 'x')), HasSubstr("more than 1048576 bytes"));
  std::istringstream input("#" + std::string(2 * kMaxYamlBytes, 'x'));
  EXPECT_THROW(load_yaml(input), YAML::Exception);
}

TEST(YamlDocument, AliasesCostNothing) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before + repeat(", " + before, 9) +
            "]\n";
  }
  EXPECT_EQ(load_yaml(bomb).size(), 40U);
  EXPECT_NE(refusal("a: *nowhere"), "accepted");
}

}  // namespace
}  // namespace cairn
