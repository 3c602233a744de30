// What every reader of text logs owes its user when the input is bad. The readers' own tests say what their
// good input means.
#include "cairn/io/text_log.hpp"

#include "cairn/io/carmen_log.hpp"
#include "cairn/io/mrpt_text_log.hpp"
#include "cairn/io/wean_log.hpp"
#include "log_inspection.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;
using ::testing::HasSubstr;

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

const std::string kCarmen =
    "# a comment\n"
    "PARAM robot_frontlaser_offset 0.3 nohost 0\n"
    "ODOM 1 2 0.5 0.1 0.2 0 11.5 nohost 0.5\n"
    "FLASER 3 1.5 2 2.5 9 9 9 1 2 0.5 12.5 nohost 0.1\n"
    "ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1 2 31 2 0.5 0.5 1.2 1 0 1 1 0 0.1 0.2 0.3 0.4 1 13.5 host "
    "0.2\n";
const std::string kWean = "O 1 2 0.5 0.25\nL 1 2 0.5 26 2 0.5" + repeated(" 100", 180) + " 0.375\n";
const std::string kMrpt =
    "FRAME 0\nODO 0.1 0 0.2\nBEACON 1 5.5\nLASER 11.5 3 80 3.14 0.1 0 0.3 1.5 2 81\nFRAME 1\n"
    "ODO 0.1 0 0.2\nLASER 12.5 3 80 3.14 0.1 0 0.3 1.5 2 81\n";

struct Reader {
  const char* name;
  Log (*read)(std::istream&, const std::string&);
  const std::string& good;
};

class TextLog : public ::testing::TestWithParam<Reader> {
 protected:
  static Log read(const std::string& text) {
    std::istringstream input(text);
    return GetParam().read(input, "a.log");
  }
  static const std::string& good() { return GetParam().good; }

  // The log, checked for what must hold whatever the input was; nullopt where the input was refused.
  static std::optional<Log> read_or_refuse(const std::string& text) {
    try {
      Log log = read(text);
      EXPECT_FALSE(log.events.empty());
      for (const Event& event : log.events) check(event, log.streams.at(event.stream));
      return log;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.log"));
      return std::nullopt;
    }
  }

 private:
  static void check(const Event& event, const StreamInfo& stream) {
    EXPECT_EQ(test::is_scan(event), stream.kind == StreamKind::kLaserScan);
    if (const auto* beacons = std::get_if<std::shared_ptr<const BeaconRanges>>(&event.payload)) {
      EXPECT_EQ(stream.kind, StreamKind::kBeaconRanges);
      for (const BeaconReading& beacon : (*beacons)->readings)
        EXPECT_TRUE(beacon.range_m > 0.0 && beacon.range_m <= 1e5);
      return;
    }
    if (!test::is_scan(event)) {
      EXPECT_TRUE(is_finite(test::pose_of(event)));
      return;
    }
    const LaserScan& scan = test::scan_of(event);
    EXPECT_TRUE(std::isfinite(scan.angle_min_rad) && std::isfinite(scan.angle_increment_rad));
    EXPECT_GT(scan.range_max_m, 0.0);
    EXPECT_FALSE(scan.ranges_m.empty());
    for (const float range : scan.ranges_m) EXPECT_FALSE(range < 0.0F);
    EXPECT_TRUE(is_finite(stream.T_base_sensor.value_or(Pose2{})));
  }
};

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream input(line);
  std::vector<std::string> fields;
  for (std::string field; input >> field;) fields.push_back(field);
  return fields;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream input(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(input, line);) lines.push_back(line);
  return lines;
}

// `text` with field `j` of line `i` replaced.
std::string with_field(const std::string& text, std::size_t i, std::size_t j, const std::string& value) {
  std::string changed;
  const auto lines = lines_of(text);
  for (std::size_t line = 0; line < lines.size(); ++line) {
    auto fields = fields_of(lines[line]);
    if (line == i) fields[j] = value;
    for (const auto& field : fields) changed += field + " ";
    changed += "\n";
  }
  return changed;
}

TEST_P(TextLog, GoodInputIsReadWithoutAWarningOfDamage) {
  const Log log = read(good());
  EXPECT_EQ(count(log, "malformed line") + count(log, "truncated line") + count(log, "time reversal"), 0);
  EXPECT_EQ(count(log, "implausible units"), 0);
}

TEST_P(TextLog, CrlfReadsTheSame) {
  std::string text = good();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
  const Log log = read(text);
  const Log expected = read(good());
  ASSERT_EQ(log.events.size(), expected.events.size());
  EXPECT_EQ(log.events.back().stamp, expected.events.back().stamp);
  EXPECT_EQ(log.diagnostics.counts(), expected.diagnostics.counts());
}

TEST_P(TextLog, EmptyIsRefused) {
  EXPECT_FALSE(read_or_refuse(""));
  EXPECT_FALSE(read_or_refuse("\n\n\r\n"));
  EXPECT_FALSE(read_or_refuse("# only a comment\n"));
}

// A cut within a line's last field can pass for a shorter number; everywhere else it is noticed.
TEST_P(TextLog, CutAtEveryByteIsRefusedOrCounted) {
  for (std::size_t size = 0; size < good().size(); ++size) {
    const auto log = read_or_refuse(good().substr(0, size));
    if (!log || size == 0) continue;
    const std::size_t rest = std::min(good().find_first_of(" \n", size), good().size());
    const bool in_last_field = rest == good().size() || good()[rest] == '\n';
    const bool at_line_end = good()[size - 1] == '\n';
    EXPECT_TRUE(at_line_end || in_last_field || count(*log, "truncated line") == 1) << size;
  }
}

TEST_P(TextLog, NoFieldTurnsBadValuesIntoBadEvents) {
  const auto lines = lines_of(good());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t n = std::min<std::size_t>(fields_of(lines[i]).size(), 40);
    for (std::size_t j = 0; j < n; ++j) {
      for (const char* value :
           {"word", "nan", "-nan", "inf", "-inf", "1e9", "1000000000", "-1", "-7.5", "1e308", "-1e308",
            "1e999", "99999999999999999999", "0", "-0", "1e-320", "0x10", "1,5", "\x01\xff"}) {
        read_or_refuse(with_field(good(), i, j, value));
      }
    }
  }
}

TEST_P(TextLog, AWordForANumberIsCounted) {
  const std::string bad = with_field(good(), lines_of(good()).size() - 1, 3, "word");
  const auto log = read_or_refuse(good() + bad.substr(bad.rfind('\n', bad.size() - 2) + 1));
  ASSERT_TRUE(log);
  EXPECT_EQ(count(*log, "malformed line"), 1);
}

TEST_P(TextLog, MostlyMalformedIsRefused) {
  EXPECT_FALSE(read_or_refuse(good() + repeated("!!\n", 20)));
  EXPECT_TRUE(read_or_refuse(good() + "!!\n"));
}

TEST_P(TextLog, StampsRunningBackwardsAreCounted) {
  const Log once = read(good());
  const Log twice = read(good() + good());
  EXPECT_EQ(twice.events.size(), 2 * once.events.size());
  EXPECT_EQ(count(twice, "time reversal"), 1);
}

// The fuzzers go further; this keeps a little of them in every test run.
TEST_P(TextLog, RandomDamageNeverGetsThrough) {
  std::mt19937 random(20240229);
  for (int round = 0; round < 3000; ++round) {
    std::string text = good();
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0) {
        text.erase(at, 1 + random() % 9);
      } else {
        text[at] = "0123456789.-+eE naif\n\r\t\xff"[random() % 23];
      }
      if (text.empty()) break;
    }
    read_or_refuse(text);
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, TextLog,
                         ::testing::Values(Reader{"carmen", read_carmen_log, kCarmen},
                                           Reader{"wean", read_wean_log, kWean},
                                           Reader{"mrpt", read_mrpt_text_log, kMrpt}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace cairn
