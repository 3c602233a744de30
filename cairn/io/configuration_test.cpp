#include "cairn/io/configuration.hpp"

#include "bad_input.hpp"

#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct StreamOptions {
  bool use = true;
  double mount_x_m = 0.0;
  bool operator==(const StreamOptions&) const = default;
};

// One option of every kind.
struct Options {
  double sigma_m = 0.1;
  int particles = 500;
  bool adaptive = true;
  std::string recipe = "mcl";
  std::string stream;
  double depth_m = 1.0;
  std::map<std::string, StreamOptions> streams;
  bool operator==(const Options&) const = default;

  void visit(OptionVisitor& v) {
    v.number({"sigma_m", "a length", {"laser_sigma"}}, sigma_m, {-1e300, 1e300});
    v.choice({"recipe", "a word"}, recipe, {"mcl", "kld_mcl"});
    v.text({"stream", "a text"}, stream);
    v.section({"filter", "a group"}, [this](OptionVisitor& inner) {
      inner.integer({"particles", "a count", {"max_particles"}}, particles, {1, 10'000'000});
      inner.flag({"adaptive", "a flag"}, adaptive);
      inner.section({"deep", "a group in a group"}, [this](OptionVisitor& d) {
        d.number({"depth_m", "a length"}, depth_m, {0.0, 10.0});
      });
    });
    std::vector<std::string> present;
    for (const auto& [name, unused] : streams) present.push_back(name);
    v.table({"streams", "a table"}, present, [this](const std::string& key, OptionVisitor& inner) {
      inner.flag({"use", "a flag"}, streams[key].use);
      inner.number({"mount_x_m", "a length"}, streams[key].mount_x_m, {-10.0, 10.0});
    });
  }
};

VisitOptions visitor_of(Options& options) {
  return [&options](OptionVisitor& v) { options.visit(v); };
}

Options read(const std::string& text) {
  Options options;
  Diagnostics diagnostics;
  std::istringstream input(text);
  read_configuration(input, "c.yaml", visitor_of(options), diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  return options;
}

std::string refusal(const std::string& text) {
  return test::error_on(
      [](std::istream& input) {
        Options options;
        Diagnostics diagnostics;
        read_configuration(input, "c.yaml", visitor_of(options), diagnostics);
      },
      text);
}

Options set(const std::vector<std::string>& settings) {
  Options options;
  apply_settings(settings, visitor_of(options));
  return options;
}

std::string set_refusal(const std::string& setting) {
  try {
    set({setting});
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Configuration, SetsWhatTheFileNames) {
  const Options o = read(
      "sigma_m: 2.5e-1\nrecipe: kld_mcl\nfilter:\n  particles: 7\n  adaptive: no\n  deep: {depth_m: 3}\n"
      "streams:\n  front: {use: false}\n  /scan.rear:\n");
  EXPECT_EQ(o.sigma_m, 0.25);
  EXPECT_EQ(o.recipe, "kld_mcl");
  EXPECT_EQ(o.particles, 7);
  EXPECT_FALSE(o.adaptive);
  EXPECT_EQ(o.depth_m, 3.0);
  ASSERT_EQ(o.streams.size(), 2U);
  EXPECT_FALSE(o.streams.at("front").use);
  EXPECT_TRUE(o.streams.at("/scan.rear").use);
}

TEST(Configuration, KeepsTheDefaultsWhereTheFileSaysNothing) {
  for (const char* text :
       {"", "\n\n", "# only words\n", "---\n", "filter:\n", "filter: {}\n", "streams:\n"}) {
    EXPECT_EQ(read(text), Options{}) << text;
  }
}

TEST(Configuration, TakesFilesOfOtherSystems) {
  EXPECT_EQ(read("\xEF\xBB\xBFsigma_m: 2\r\nfilter:\r\n  particles: 9\r\n").particles, 9);
  EXPECT_EQ(read("sigma_m: &b 4\nfilter: {deep: {depth_m: *b}}\n").depth_m, 4.0);
}

TEST(Configuration, UnknownKeysNameTheNearest) {
  EXPECT_EQ(refusal("sigma_n: 1"), "c.yaml:1:1: unknown key 'sigma_n'; did you mean 'sigma_m'?");
  EXPECT_EQ(refusal("filter:\n  partikles: 1"),
            "c.yaml:2:3: unknown key 'partikles'; did you mean 'particles'?");
  EXPECT_THAT(refusal("particles: 1"), EndsWith("did you mean 'filter.particles'?"));
  EXPECT_THAT(refusal("streams: {front: {usw: true}}"), EndsWith("did you mean 'use'?"));
  EXPECT_THAT(refusal("image: map.png"), HasSubstr("known here: sigma_m, recipe"));
  EXPECT_THAT(refusal("<<: {sigma_m: 1}"), HasSubstr("unknown key '<<'"));
}

TEST(Configuration, RefusesValuesOfTheWrongKind) {
  for (const char* value : {"abc", "[1, 2]", "{a: 1}", "", "~", "true", "1 2", "1e", "0x", "--1", "1,5"}) {
    EXPECT_THAT(refusal(std::string("sigma_m: ") + value), HasSubstr("sigma_m is no number")) << value;
  }
  EXPECT_THAT(refusal("filter: {particles: 1.5}"), HasSubstr("particles is no whole number"));
  EXPECT_THAT(refusal("filter: {adaptive: 1}"), HasSubstr("adaptive is neither true nor false"));
  EXPECT_THAT(refusal("recipe: amcl"), HasSubstr("recipe 'amcl' is not known"));
  EXPECT_THAT(refusal("recipe: [mcl]"), HasSubstr("recipe '' is not known"));
  EXPECT_THAT(refusal("stream: [a]"), HasSubstr("stream is no text"));
}

TEST(Configuration, RefusesNumbersThatAreNone) {
  for (const char* value : {".nan", ".NaN", ".inf", "-.inf", "+.INF", "1e999"}) {
    EXPECT_THAT(refusal(std::string("sigma_m: ") + value),
                AllOf(StartsWith("c.yaml:1:10: sigma_m is "), HasSubstr("give a value from")))
        << value;
  }
}

TEST(Configuration, RefusesWhatIsOutOfRange) {
  EXPECT_EQ(refusal("filter: {particles: 0}"),
            "c.yaml:1:21: particles is out of range; give a value from 1 to 1e+07");
  EXPECT_THAT(refusal("filter: {particles: 10000001}"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("filter: {particles: 99999999999999999999}"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("filter: {deep: {depth_m: -1e-300}}"), HasSubstr("out of range"));
}

TEST(Configuration, RefusesKeysThatStandTwice) {
  EXPECT_EQ(refusal("sigma_m: 1\nsigma_m: 2"), "c.yaml:2:1: key 'sigma_m' stands twice; remove one");
  EXPECT_THAT(refusal("streams: {a: {}, a: {}}"), HasSubstr("key 'a' stands twice"));
  EXPECT_THAT(refusal("filter: {particles: 1, particles: 1}"), HasSubstr("stands twice"));
  EXPECT_THAT(refusal("? [a, b]\n: 1"), HasSubstr("a key is no single word"));
}

TEST(Configuration, RefusesOtherShapes) {
  EXPECT_THAT(refusal("- sigma_m\n- recipe"), HasSubstr("no list of 'key: value' pairs"));
  EXPECT_THAT(refusal("word"), HasSubstr("no list of 'key: value' pairs"));
  EXPECT_THAT(refusal("filter: 3"), HasSubstr("filter is a group of options, not a value"));
  EXPECT_THAT(refusal("filter: [particles]"), HasSubstr("filter is a group of options"));
  EXPECT_THAT(refusal("streams: front"), HasSubstr("streams is a group of options"));
  EXPECT_THAT(refusal("streams: {front: true}"), HasSubstr("front is a group of options"));
  EXPECT_THAT(refusal("sigma_m: 1\n---\nsigma_m: 2"), HasSubstr("more than one YAML document"));
}

TEST(Configuration, RefusesWhatIsNoYaml) {
  for (const char* text : {"a: [1", "a: \"open", "\tsigma_m: 1", "filter:\n\tparticles: 1", "a: b: c", "}",
                           "sigma_m: *nowhere", "%YAML 9.9 9\n---\n", "sigma_m: !!", "\x01"}) {
    EXPECT_THAT(refusal(text), StartsWith("c.yaml")) << text;
  }
  EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("deep"));
}

TEST(Configuration, EveryCutIsReadOrRefused) {
  const std::string whole = write_configuration([](OptionVisitor& v) { Options().visit(v); });
  const auto read_it = [](std::istream& input) {
    Options options;
    Diagnostics diagnostics;
    read_configuration(input, "c.yaml", visitor_of(options), diagnostics);
  };
  EXPECT_TRUE(test::is_accepted(read_it, whole));
  EXPECT_GT(test::accepted_cuts(read_it, whole), whole.size() / 2) << "most cuts end inside a comment";
}

TEST(Settings, LaterOnesWin) {
  const Options o = set({"filter.particles=3", "sigma_m=-2", "filter.particles=4", "stream=a=b",
                         "filter.deep.depth_m=0.5", "streams.front.use=false", "filter={adaptive: false}"});
  EXPECT_EQ(o.particles, 4);
  EXPECT_EQ(o.sigma_m, -2.0);
  EXPECT_EQ(o.stream, "a=b");
  EXPECT_EQ(o.depth_m, 0.5);
  EXPECT_FALSE(o.streams.at("front").use);
  EXPECT_FALSE(o.adaptive);
}

TEST(Settings, RefuseWithTheirOwnText) {
  EXPECT_EQ(set_refusal("filter.partikles=1"),
            "--set filter.partikles=1: unknown key 'partikles'; did you mean 'particles'?");
  EXPECT_THAT(set_refusal("particles=1"), EndsWith("did you mean 'filter.particles'?"));
  EXPECT_EQ(set_refusal("filter.particles=x"),
            "--set filter.particles=x: particles is no number; give a value from 1 to 1e+07");
  EXPECT_THAT(set_refusal("filter=3"), HasSubstr("filter is a group of options, not a value"));
  EXPECT_THAT(set_refusal("filter="), HasSubstr("set one of them: filter.option=value"));
  EXPECT_THAT(set_refusal("streams.front="), HasSubstr("front is a group of options"));
  for (const char* text : {"", "=", "=1", "sigma_m", "sigma_m 1"}) {
    EXPECT_THAT(set_refusal(text), HasSubstr("is not key=value")) << text;
  }
  for (const char* text :
       {".=1", "filter.=1", ".sigma_m=1", "sigma_m.a=1", "sigma_m=[", "sigma_m=", "a\n=1"}) {
    EXPECT_THAT(set_refusal(text), StartsWith("--set ")) << text;
  }
}

TEST(Settings, RefuseDepthAndLength) {
  EXPECT_THAT(set_refusal(std::string(100'000, '.') + "=1"), HasSubstr("too many dots"));
  EXPECT_THAT(set_refusal("sigma_m=" + std::string(100'000, '[')), HasSubstr("deep"));
  EXPECT_LT(set_refusal(std::string(100'000, 'x') + "=1").size(), 400U);
}

TEST(WriteConfiguration, ReadsBackToTheLastBit) {
  Options o;
  for (const double value :
       {0.1, 1.0 / 3.0, -1e300, 5e-324, 2.2250738585072014e-308, 1e15, 123456789.125, -0.0}) {
    o.sigma_m = value;
    const Options back = read(write_configuration(visitor_of(o)));
    EXPECT_EQ(back.sigma_m, value);
    EXPECT_EQ(std::signbit(back.sigma_m), std::signbit(value));
  }
  o.particles = 1234567;
  o.adaptive = false;
  o.recipe = "kld_mcl";
  o.streams["front"] = {false, 0.7};
  EXPECT_EQ(read(write_configuration(visitor_of(o))), o);
}

TEST(WriteConfiguration, KeepsNamesWithOddCharacters) {
  for (const std::string name : {"/scan/front",
                                 "a.b",
                                 "a b",
                                 " a ",
                                 "#",
                                 "a: b",
                                 "- x",
                                 "'",
                                 "\"",
                                 "\\",
                                 "a\\n",
                                 "a\nb",
                                 "a\r\n",
                                 "\t",
                                 "null",
                                 "Null",
                                 "NULL",
                                 "~",
                                 "true",
                                 "no",
                                 "1e3",
                                 ".nan",
                                 "*a",
                                 "&a",
                                 "!",
                                 "%",
                                 "@",
                                 "[",
                                 "{}",
                                 "?",
                                 "",
                                 "\xC3\xA4",
                                 "\xE2\x80\xA8",
                                 "\xEF\xBB\xBF",
                                 "\xFF\xFE",
                                 "\x01\x04\x1b\x7f",
                                 "<<"}) {
    Options o;
    o.stream = name;
    o.streams[name] = {false, 1.0};
    const std::string text = write_configuration(visitor_of(o));
    EXPECT_EQ(read(text), o) << text;
  }
  Options o;
  o.streams[std::string("a\0b", 3)] = {};
  EXPECT_EQ(read(write_configuration(visitor_of(o))), o);
}

constexpr const char* kAmcl = R"(amcl:
  ros__parameters:
    use_sim_time: True
    max_particles: 2000
    laser_sigma: 0.2
    robot_model_type: "nav2_amcl::DifferentialMotionModel"
    scan_topic: scan
bt_navigator:
  ros__parameters:
    global_frame: map
)";

TEST(AmclParameters, TakesOverWhatHasACounterpartAndCountsTheRest) {
  Options options;
  Diagnostics diagnostics;
  std::istringstream input(kAmcl);
  read_configuration(input, "nav2.yaml", visitor_of(options), diagnostics);
  EXPECT_EQ(options.particles, 2000);
  EXPECT_EQ(options.sigma_m, 0.2);
  EXPECT_EQ(diagnostics.counts().at("AMCL parameter without counterpart"), 3);
  EXPECT_EQ(diagnostics.examples().front().text, "nav2.yaml:3:5: use_sim_time");
}

TEST(AmclParameters, RefusesBadValuesWithTheirPlace) {
  EXPECT_THAT(refusal("amcl:\n  ros__parameters:\n    max_particles: many\n"),
              StartsWith("c.yaml:3:20: max_particles is no number"));
  EXPECT_THAT(refusal("amcl: {ros__parameters: {max_particles: 0}}"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("amcl: {ros__parameters: {a: 1, a: 2}}"), HasSubstr("stands twice"));
  EXPECT_THAT(refusal("amcl: {ros__parameters: {[a]: 1}}"), HasSubstr("no single word"));
  EXPECT_THAT(refusal("amcl: {ros__parameters: 3}"), HasSubstr("unknown key 'amcl'"));
}

}  // namespace
}  // namespace cairn
