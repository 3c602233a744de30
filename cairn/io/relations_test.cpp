#include "cairn/io/relations.hpp"

#include "bad_input.hpp"
#include "test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::error_on;
using ::testing::HasSubstr;

std::vector<Relation> relations(std::istream& input) { return read_relations(input, "f"); }

TEST(Relations, ReadsBlanksAndCommas) {
  std::istringstream input("# c\n1.5 2.5 0.1 0.2 9 9 9 0.3\n3.5,4.5,0.1,0.2,0,0,0,-0.3\r\n");
  const auto read = relations(input);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0], (Relation{time_from_seconds(1.5), time_from_seconds(2.5), {0.1, 0.2, 0.3}}));
  EXPECT_EQ(read[1], (Relation{time_from_seconds(3.5), time_from_seconds(4.5), {0.1, 0.2, -0.3}}));
}

TEST(Relations, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_on(relations, "1 2 3 4 5 6 7\n"), HasSubstr("the line ends where the yaw belongs"));
  EXPECT_THAT(error_on(relations, "1 2 3 4 5 6 7 8 9\n"), HasSubstr("too many"));
  EXPECT_THAT(error_on(relations, "1 2 3 up 5 6 7 8\n"), HasSubstr("f:1:7: 'up'"));
  EXPECT_THAT(error_on(relations, "1 nan 3 4 5 6 7 8\n"), HasSubstr("f:1:3"));
  EXPECT_THAT(error_on(relations, "\n"), HasSubstr("no relation"));
}

TEST(Relations, NoCutCrashes) {
  EXPECT_GT(test::accepted_cuts(relations, "1.5 2.5 0.1 0.2 9 9 9 0.3\n3.5,4.5,0.1,0.2,0,0,0,-0.3\n"), 0u);
}

TEST(Relations, ReadsTheRealFiles) {
  CAIRN_SKIP_WITHOUT("radish_raw/intel.relations");
  EXPECT_GT(read_relations(test::data_file("radish_raw/intel.relations")).size(), 100u);
}

}  // namespace
}  // namespace cairn
