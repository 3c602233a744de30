#include "cairn/localization/localizer_options.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

// Every field by its dotted name; numbers can be set through it.
class Fields final : public OptionVisitor {
 public:
  std::map<std::string, double> numbers;
  std::map<std::string, Range> ranges;
  std::map<std::string, std::string> texts;
  std::map<std::string, std::string> documentation;
  std::string set;  ///< name of the number to set
  double to = 0.0;

  void number(const Field& field, double& value, Range range) override { take(field, value, range); }
  void integer(const Field& field, int& value, Range range) override { take(field, value, range); }
  void flag(const Field& field, bool& value) override { texts[name(field)] = value ? "true" : "false"; }
  void choice(const Field& field, std::string& value, const std::vector<std::string>&) override {
    texts[name(field)] = value;
  }
  void text(const Field& field, std::string& value) override { texts[name(field)] = value; }
  void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) override {
    inside(name(field), [&] { visit(*this); });
  }
  void table(const Field& field, const std::vector<std::string>& present,
             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) override {
    for (const std::string& key : present) inside(name(field) + "." + key, [&] { visit_entry(key, *this); });
  }

 private:
  template <class Value>
  void take(const Field& field, Value& value, Range range) {
    const std::string key = name(field);
    EXPECT_FALSE(numbers.contains(key)) << key << " is visited twice";
    if (key == set) value = static_cast<Value>(to);
    numbers[key] = static_cast<double>(value);
    ranges[key] = range;
  }
  std::string name(const Field& field) {
    EXPECT_NE(field.documentation, "") << prefix_ + field.name;
    return prefix_ + field.name;
  }
  void inside(const std::string& path, const std::function<void()>& visit) {
    const std::string outer = prefix_;
    prefix_ = path + ".";
    visit();
    prefix_ = outer;
  }
  std::string prefix_;
};

LocalizerOptions with_streams() {
  LocalizerOptions options;
  options.streams["front"] = {};
  options.streams["rear"] = {};
  return options;
}

Fields fields_of(LocalizerOptions options) {
  Fields fields;
  options.visit(fields);
  return fields;
}

std::string complaint_about(const LocalizerOptions& options) {
  try {
    options.validate();
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "valid";
}

TEST(LocalizerOptions, TheDefaultsAreValid) {
  EXPECT_EQ(complaint_about({}), "valid");
  EXPECT_EQ(complaint_about(with_streams()), "valid");
}

TEST(LocalizerOptions, EveryNumberIsReachedAndItsRangeHolds) {
  const Fields before = fields_of(with_streams());
  EXPECT_GE(before.numbers.size(), 40U);
  for (const auto& [key, range] : before.ranges) {
    ASSERT_TRUE(std::isfinite(range.min) && std::isfinite(range.max)) << key;
    for (const double wrong : {range.min - 1.0, range.max + 1.0}) {
      LocalizerOptions options = with_streams();
      Fields setter;
      setter.set = key;
      setter.to = wrong;
      options.visit(setter);
      EXPECT_THAT(complaint_about(options), HasSubstr(key + ": is out of range; give a value from"));
    }
  }
}

TEST(LocalizerOptions, RefusesNan) {
  LocalizerOptions options;
  options.motion.alpha1 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint_about(options), HasSubstr("motion.alpha1"));
}

TEST(LocalizerOptions, RefusesValuesThatDoNotFitEachOther) {
  LocalizerOptions options;
  options.filter.min_particles = 501;
  options.filter.max_particles = 500;
  EXPECT_THAT(complaint_about(options), HasSubstr("filter.min_particles"));
  options = with_streams();
  options.streams["rear"].limits = {2.0, 2.0};
  EXPECT_THAT(complaint_about(options), HasSubstr("streams.rear.min_range_m"));
  options = {};
  options.recipe = "mlc";
  EXPECT_THAT(complaint_about(options), HasSubstr("'mlc' is not known"));
}

TEST(LocalizerOptions, VisitingChangesNothing) {
  LocalizerOptions options = with_streams();
  Fields first;
  options.visit(first);
  const Fields second = fields_of(options);
  EXPECT_EQ(first.numbers, second.numbers);
  EXPECT_EQ(first.texts, second.texts);
  EXPECT_EQ(options.streams.size(), 2U);
}

}  // namespace
}  // namespace cairn
