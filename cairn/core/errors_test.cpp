#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(InputError, IsOneSentenceWithWhereWhatAndRemedy) {
  const InputError error("a.log:7:3", "is no number", "correct the line");
  EXPECT_STREQ(error.what(), "a.log:7:3: is no number; correct the line");
  EXPECT_EQ(error.where(), "a.log:7:3");
  EXPECT_STREQ(InputError("a.log", "is empty", "").what(), "a.log: is empty");
}

TEST(ConfigurationError, IsAnInputErrorThatCanBeToldApart) {
  const auto fail = [] { throw ConfigurationError("threads", "is 0", "use 1 or more"); };
  EXPECT_THROW(fail(), ConfigurationError);
  EXPECT_THROW(fail(), InputError);
  const auto unreadable = [] { throw InputError("a.log", "is empty", ""); };
  try {
    unreadable();
    FAIL();
  } catch (const ConfigurationError&) {
    FAIL() << "an unreadable input is no configuration error";
  } catch (const InputError&) {
  }
}

TEST(Assert, ThrowsWithExpressionAndPlace) {
  EXPECT_NO_THROW(CAIRN_ASSERT(1 + 1 == 2));
  try {
    CAIRN_ASSERT(1 + 1 == 3);
    FAIL();
  } catch (const std::logic_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("1 + 1 == 3"), std::string::npos) << text;
    EXPECT_NE(text.find("errors_test.cpp:"), std::string::npos) << text;
  }
}

TEST(Assert, EvaluatesOnce) {
  int evaluations = 0;
  CAIRN_ASSERT(++evaluations == 1);
  EXPECT_EQ(evaluations, 1);
}

}  // namespace
}  // namespace cairn
