#include "cairn/core/diagnostics.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Diagnostics, CountsAllAndKeepsTheFirstThreeOfEachKind) {
  Diagnostics diagnostics;
  for (int line = 1; line <= 5; ++line) {
    diagnostics.warn("malformed line", "a.log:" + std::to_string(line), "no number");
  }
  diagnostics.warn("time reversal", "a.log:9", "0.1 s back");
  EXPECT_EQ(diagnostics.counts().at("malformed line"), 5);
  EXPECT_EQ(diagnostics.counts().at("time reversal"), 1);
  ASSERT_EQ(diagnostics.examples().size(), 4u);
  EXPECT_EQ(diagnostics.examples()[0].kind, "malformed line");
  EXPECT_EQ(diagnostics.examples()[0].text, "a.log:1: no number");
  EXPECT_EQ(diagnostics.examples()[2].text, "a.log:3: no number");
  EXPECT_EQ(diagnostics.examples()[3].text, "a.log:9: 0.1 s back");
}

TEST(Diagnostics, CountsWithoutExamples) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.empty());
  diagnostics.count("duplicate stamp", 7);
  diagnostics.count("duplicate stamp");
  EXPECT_FALSE(diagnostics.empty());
  EXPECT_EQ(diagnostics.counts().at("duplicate stamp"), 8);
  EXPECT_TRUE(diagnostics.examples().empty());
}

// A damaged file announces any number of lost bytes, more than once.
TEST(Diagnostics, CountsStopAtTheLargestNumber) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  Diagnostics diagnostics, other;
  diagnostics.count("lost bytes", 997);
  diagnostics.count("lost bytes", std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(diagnostics.counts().at("lost bytes"), kMost);
  other.count("lost bytes", 5);
  other.add(diagnostics);
  EXPECT_EQ(other.counts().at("lost bytes"), kMost);
}

}  // namespace
}  // namespace cairn
