#include "cairn/io/text_fields.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream input(text);
  LineReader reader(input, "f");
  std::vector<std::string> lines;
  while (reader.next()) lines.emplace_back(reader.line());
  return lines;
}

TEST(LineReader, LfCrlfAndNoEndAtAll) {
  EXPECT_THAT(lines_of("a\nb\n"), ElementsAre("a", "b"));
  EXPECT_THAT(lines_of("a\r\n\r\nb"), ElementsAre("a", "", "b"));
  EXPECT_THAT(lines_of(""), ElementsAre());
  EXPECT_THAT(lines_of("\xef\xbb\xbfmode\n"), ElementsAre("mode"));
}

TEST(LineReader, KnowsWhereItIs) {
  std::istringstream input("a\nb");
  LineReader reader(input, "some.log");
  reader.next();
  EXPECT_EQ(reader.where(), "some.log:1");
  EXPECT_TRUE(reader.line_was_ended());
  reader.next();
  EXPECT_EQ(reader.where(), "some.log:2");
  EXPECT_FALSE(reader.line_was_ended());
  EXPECT_FALSE(reader.next());
}

/// One line, already read.
struct Line {
  explicit Line(const std::string& text) : input(text), reader(input, "f.txt") { reader.next(); }
  std::istringstream input;
  LineReader reader;
};

template <typename Read>
std::string error_of(const std::string& text, Read read) {
  const Line line(text);
  FieldReader fields(line.reader);
  try {
    fields.word("name");
    read(fields);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FieldReader, ReadsTypedFields) {
  const Line line("  ODOM\t-1.5 +2e1 42 976052857.337530 nan -inf ");
  FieldReader fields(line.reader);
  EXPECT_EQ(fields.fields_left(), 7U);
  EXPECT_EQ(fields.word("name"), "ODOM");
  EXPECT_EQ(fields.number("x"), -1.5);
  EXPECT_EQ(fields.number("y"), 20.0);
  EXPECT_EQ(fields.where(), "f.txt:1:13");
  EXPECT_EQ(fields.integer("n"), 42);
  EXPECT_EQ(fields.time("stamp").time_since_epoch().count(), 976052857337530000);
  EXPECT_TRUE(std::isnan(fields.maybe_not_finite("range")));
  EXPECT_EQ(fields.maybe_not_finite("range"), -INFINITY);
  EXPECT_TRUE(fields.at_end());
  EXPECT_EQ(fields.fields_left(), 0U);
}

TEST(FieldReader, CommasSeparateExactlyTwoFields) {
  const Line line("1, 2 ,3 4,");
  FieldReader fields(line.reader, " ,");
  EXPECT_EQ(fields.fields_left(), 4U);
  for (const double expected : {1.0, 2.0, 3.0, 4.0}) EXPECT_EQ(fields.number("value"), expected);
  EXPECT_TRUE(fields.at_end());

  const Line gap("1,,3");
  FieldReader with_gap(gap.reader, ",");
  EXPECT_EQ(with_gap.fields_left(), 3U);
  with_gap.number("x");
  EXPECT_THROW(with_gap.number("y"), InputError);
}

TEST(FieldReader, BlankLineIsAtEnd) {
  const Line line(" \t ");
  EXPECT_TRUE(FieldReader(line.reader).at_end());
}

TEST(FieldReader, TimeWithExponentAndOutOfRange) {
  const Line line("9.76052857e8 1e300 9999999999 nan");
  FieldReader fields(line.reader);
  EXPECT_EQ(fields.time("stamp").time_since_epoch().count(), 976052857000000000);
  EXPECT_THROW(fields.time("stamp"), InputError);
  EXPECT_THROW(fields.time("stamp"), InputError);
  EXPECT_THROW(fields.time("stamp"), InputError);
}

TEST(FieldReader, ErrorsSayWhereAndWhat) {
  const auto number = [](FieldReader& fields) { fields.number("heading"); };
  EXPECT_THAT(error_of("A x1", number), HasSubstr("f.txt:1:3: 'x1' stands where the heading belongs; "));
  EXPECT_THAT(error_of("A 1.5x", number), HasSubstr("'1.5x'"));
  EXPECT_THAT(error_of("A", number), HasSubstr("f.txt:1:2: the line ends where the heading belongs"));
  EXPECT_THAT(error_of("A nan", number), HasSubstr("heading is not finite"));
  EXPECT_THAT(error_of("A inf", number), HasSubstr("heading is not finite"));
  EXPECT_THAT(error_of("A 1e999", number), HasSubstr("beyond what a double holds"));
  EXPECT_THAT(error_of("A +-1", number), HasSubstr("'+-1'"));
  EXPECT_THAT(error_of("A \x1b[2J", number), HasSubstr("'?[2J'"));
  EXPECT_EQ(error_of("A " + std::string(10000, 'x'), number).size(),
            error_of("A " + std::string(100, 'x'), number).size());
}

TEST(FieldReader, ExpectEndNamesTheFirstFieldTooMany) {
  const auto end = [](FieldReader& fields) { fields.expect_end(); };
  EXPECT_EQ(error_of("A ", end), "no error");
  EXPECT_THAT(error_of("A  b c", end), HasSubstr("f.txt:1:4: more fields"));
}

TEST(FieldReader, IntegersAreWholeAndFit) {
  const auto integer = [](FieldReader& fields) { fields.integer("count"); };
  EXPECT_EQ(error_of("A -7", integer), "no error");
  EXPECT_THAT(error_of("A 7.5", integer), HasSubstr("whole number"));
  EXPECT_THAT(error_of("A 99999999999999999999", integer), HasSubstr("whole number"));
}

}  // namespace
}  // namespace cairn
