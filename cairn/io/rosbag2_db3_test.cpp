#include "cairn/io/rosbag2_db3.hpp"

#include "bad_input.hpp"
#include "db3_writer.hpp"
#include "log_inspection.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;

Log read(const std::string& bytes) {
  std::istringstream input(bytes);
  return read_rosbag2_db3(input, "a.db3");
}

std::string error_of(const std::string& bytes) {
  return test::error_on([](std::istream& input) { read_rosbag2_db3(input, "a.db3"); }, bytes);
}

std::string small_bag(int scans) {
  test::Db3Writer bag;
  bag.create();
  bag.topic(1, "/scan", "sensor_msgs/msg/LaserScan");
  bag.topic(2, "/odom", "nav_msgs/msg/Odometry");
  for (int i = 0; i < scans; ++i) {
    bag.message(1, 1'000'000'000 + i, test::cdr_scan(static_cast<float>(i + 1)));
    bag.message(2, 2'000'000'000 + i, test::cdr_odometry(0.5 * i));
  }
  return bag.bytes();
}

TEST(Rosbag2Db3, ReadsItsMessagesInTheOrderOfRecording) {
  const Log log = read(small_bag(3));
  EXPECT_EQ(log.format, "rosbag2_db3");
  ASSERT_EQ(log.streams.size(), 2U);
  EXPECT_EQ(log.streams[0].name, "/scan");
  EXPECT_EQ(log.streams[1].kind, StreamKind::kOdometry);
  ASSERT_EQ(log.events.size(), 6U);
  EXPECT_EQ(log.events[2].arrival, Time(Duration(1'000'000'001)));
  EXPECT_EQ(test::scan_of(log.events[4]).ranges_m.at(0), 3.0F);
  EXPECT_EQ(test::pose_of(log.events[5]).x, 1.0);
  EXPECT_EQ(log.diagnostics.counts(), (std::map<std::string, std::int64_t>{{"unknown mount", 1}}));
}

TEST(Rosbag2Db3, ReadsTheSchemaOfNewerRosbag2) {
  test::Db3Writer bag;
  bag.sql("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)");
  bag.sql(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format "
      "TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL)");
  bag.sql(
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL)");
  bag.sql("INSERT INTO topics VALUES(7, '/odom', 'nav_msgs/msg/Odometry', 'cdr', '', 'RIHS01_0')");
  bag.message(7, 5, test::cdr_odometry(1.0));
  bag.message(8, 5, "");
  const Log log = read(bag.bytes());
  EXPECT_EQ(log.events.size(), 1U);
  EXPECT_EQ(count(log, "message of an unknown topic"), 1);
}

TEST(Rosbag2Db3, EveryCutIsReadAsFarAsItGoesOrRefused) {
  const std::string whole = small_bag(40);
  std::size_t partly = 0;
  for (std::size_t size = 0; size < whole.size(); size += 37) {
    const auto read_cut = [&](std::istream& input) {
      const Log log = read_rosbag2_db3(input, "a.db3");
      EXPECT_LE(log.events.size(), 80U);
      EXPECT_EQ(count(log, "truncated"), 1) << size;
      EXPECT_EQ(count(log, "lost bytes"), static_cast<std::int64_t>(whole.size() - size));
      partly += log.events.empty() ? 0 : 1;
    };
    test::is_accepted(read_cut, whole.substr(0, size));
  }
  EXPECT_GT(partly, 0U);
}

TEST(Rosbag2Db3, NoFlippedByteCrashes) {
  const std::string whole = small_bag(2);
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string bytes = whole;
    bytes[i] ^= '\xff';
    test::is_accepted([](std::istream& input) { read_rosbag2_db3(input, "a.db3"); }, bytes);
  }
}

TEST(Rosbag2Db3, ADatabaseWithAWriteAheadLogIsReadWithoutIt) {
  std::string bytes = small_bag(2);
  bytes[18] = bytes[19] = 2;
  const Log log = read(bytes);
  EXPECT_EQ(log.events.size(), 4U);
  EXPECT_EQ(count(log, "unfinished"), 1);
}

// Views run what a stranger wrote: here, for ever.
TEST(Rosbag2Db3, TablesThatAreViewsAreRefused) {
  test::Db3Writer bag;
  bag.sql("CREATE VIEW topics AS SELECT 1 AS id, 'a' AS name, 'b' AS type, 'cdr' AS serialization_format");
  bag.sql(
      "CREATE VIEW messages AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) SELECT 1 AS "
      "topic_id, "
      "1 AS timestamp, x AS data, 1 AS rowid FROM n");
  EXPECT_THAT(error_of(bag.bytes()), testing::HasSubstr("without the tables of a ROS 2 bag"));
}

TEST(Rosbag2Db3, TellsWhatIsNoBag) {
  EXPECT_THAT(error_of(""), testing::HasSubstr("is no SQLite database"));
  EXPECT_THAT(error_of("hello"), testing::HasSubstr("is no SQLite database"));
  EXPECT_THAT(error_of(std::string("SQLite format 3\0", 16) + "x"),
              testing::HasSubstr("ends within its header"));
  test::Db3Writer other;
  other.sql("CREATE TABLE letters(id INTEGER)");
  EXPECT_THAT(error_of(other.bytes()), testing::HasSubstr("without the tables of a ROS 2 bag"));
  EXPECT_THAT(error_of(std::string("SQLite format 3\0", 16) + std::string(5000, '\x5a')),
              testing::HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace cairn
