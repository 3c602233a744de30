#include "cairn/io/tum_trajectory.hpp"

#include "bad_input.hpp"
#include "cairn/core/angle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

Trajectory read(const std::string& text) {
  std::istringstream input(text);
  Diagnostics diagnostics;
  return read_tum(input, "f", diagnostics);
}

void read_it(std::istream& input) {
  Diagnostics diagnostics;
  read_tum(input, "f", diagnostics);
}

std::string error_of(const std::string& text) { return test::error_on(read_it, text); }

TEST(ReadTum, TakesThePlanarPart) {
  const Trajectory poses =
      read("# t x y z qx qy qz qw\n1.5 2 -3 9 0 0 0.7071067811865476 0.7071067811865476\r\n");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].stamp, time_from_seconds(1.5));
  EXPECT_EQ(poses[0].pose.x, 2.0);
  EXPECT_EQ(poses[0].pose.y, -3.0);
  EXPECT_NEAR(poses[0].pose.theta, kPi / 2, 1e-12);
}

TEST(ReadTum, YawDoesNotChangeWhenTheQuaternionTurnsItsSign) {
  EXPECT_NEAR(read("0 0 0 0 0 0 0.6 0.8\n")[0].pose.theta, read("0 0 0 0 0 0 -0.6 -0.8\n")[0].pose.theta,
              1e-12);
}

TEST(ReadTum, NamesThePlaceOfWhatIsWrong) {
  EXPECT_THAT(error_of("0 0 0 0 0 0 0 1\n1 2 east 0 0 0 0 1\n"), HasSubstr("f:2:5: 'east'"));
  EXPECT_THAT(error_of("0 0 nan 0 0 0 0 1\n"), HasSubstr("f:1:5"));
  EXPECT_THAT(error_of("0 0 0 0 0 0 0 inf\n"), HasSubstr("f:1:15"));
  EXPECT_THAT(error_of("0 0 0 0 0 0 0\n"), HasSubstr("the line ends where the qw belongs"));
  EXPECT_THAT(error_of("0 0 0 0 0 0 0 1 7\n"), HasSubstr("1 fields too many"));
  EXPECT_THAT(error_of("0 0 0 0 0 0 0 0\n"), HasSubstr("length is 0.0"));
  EXPECT_THAT(error_of("0 0 0 0 1e300 0 0 0\n"), HasSubstr("length is inf"));
  EXPECT_THAT(error_of("0 1e9 0 0 0 0 0 1\n"), HasSubstr("more than 100000 km"));
  EXPECT_THAT(error_of("5e9 0 0 0 0 0 0 1\n"), HasSubstr("145 years"));
  EXPECT_THAT(error_of(""), HasSubstr("no pose"));
}

TEST(ReadTum, AcceptsOfACutFileOnlyWhatLooksWhole) {
  const std::string text = "1.0 2.0 3.0 0 0 0 0 1\n2.0 2.0 3.0 0 0 0 0 1\n";
  // Cuts after "1" and after the line end of each line: two for the first line, one for the last.
  EXPECT_EQ(test::accepted_cuts(read_it, text), 3u);
}

TEST(WriteTum, IsReadBackTheSame) {
  const Trajectory poses = {{Time(std::chrono::nanoseconds(976052857337530123)), {1.25, -2.5, -kPi}},
                            {Time(std::chrono::nanoseconds(976052858000000000)), {1e5 + 1e-9, 0, 1.0}}};
  std::ostringstream output;
  write_tum(output, poses);
  const Trajectory back = read(output.str());
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].stamp, poses[i].stamp);
    EXPECT_NEAR(back[i].pose.x, poses[i].pose.x, 1e-9);
    EXPECT_NEAR(angle_difference(back[i].pose.theta, poses[i].pose.theta), 0.0, 1e-11);
  }
}

TEST(WriteTum, WritesTheseBytes) {
  std::ostringstream output;
  write_tum(output, {{time_from_seconds(1.5), {1, -2, 0}}});
  EXPECT_EQ(output.str(), "1.500000000 1.000000000 -2.000000000 0 0 0 0.000000000000 1.000000000000\n");
}

TEST(WriteTum, ToAPlaceThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_tum(std::filesystem::path("/no/such/folder/a.tum"), {}), InputError);
  EXPECT_THROW(write_tum(std::filesystem::temp_directory_path(), {}), InputError);
}

}  // namespace
}  // namespace cairn
