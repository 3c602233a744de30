#include "cairn/io/option_suggestion.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const std::vector<std::string> kKnown = {"particles", "max_particles", "recipe"};

TEST(Suggest, NamesTheNearest) {
  EXPECT_EQ(suggest("max_particle", kKnown), "did you mean 'max_particles'?");
  EXPECT_EQ(suggest("recpie", kKnown), "did you mean 'recipe'?");
  EXPECT_EQ(suggest("Particles", kKnown), "did you mean 'particles'?");
}

TEST(Suggest, FindsTheNameInAnotherGroup) {
  EXPECT_EQ(suggest("max_particles", {"motion", "filter"}, {"filter.max_particles", "motion.alpha1"}),
            "did you mean 'filter.max_particles'?");
}

TEST(Suggest, ListsAllWhereNothingIsNear) {
  EXPECT_EQ(suggest("image", kKnown), "known here: particles, max_particles, recipe");
  EXPECT_EQ(suggest("", {"a_long_name"}), "known here: a_long_name");
  EXPECT_EQ(suggest("anything", {}), "remove it");
  EXPECT_EQ(suggest(std::string(1'000'000, 'x'), {"x"}), "known here: x") << "and takes no time";
}

TEST(Quoted, IsFitForAMessage) {
  EXPECT_EQ(quoted("scan/front"), "'scan/front'");
  EXPECT_EQ(quoted("a\n\x1b[2J\xff"), "'a\\x0a\\x1b[2J\\xff'");
  EXPECT_EQ(quoted(std::string(61, 'a')), "'" + std::string(60, 'a') + "...'");
}

}  // namespace
}  // namespace cairn
