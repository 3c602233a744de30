#pragma once

#include "cairn/io/ros2_messages.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sqlite3.h>

/// Writes small ROS 2 bags in SQLite form into memory, with the statements of rosbag2_storage_sqlite3.
namespace cairn::test {

class Db3Writer {
 public:
  Db3Writer() {
    if (sqlite3_open(":memory:", &database_) != SQLITE_OK) throw std::runtime_error("sqlite3_open");
  }
  ~Db3Writer() { sqlite3_close(database_); }
  Db3Writer(const Db3Writer&) = delete;
  Db3Writer& operator=(const Db3Writer&) = delete;

  void sql(const std::string& statement) {
    if (sqlite3_exec(database_, statement.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
      throw std::runtime_error(sqlite3_errmsg(database_));
    }
  }

  void create() {
    sql("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
    sql("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
        "NULL, "
        "data BLOB NOT NULL)");
    sql("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  }

  void topic(int id, const std::string& name, const std::string& type) {
    sql("INSERT INTO topics VALUES(" + std::to_string(id) + ", '" + name + "', '" + type + "', 'cdr', '')");
  }

  void message(int topic, std::int64_t timestamp, std::string_view data) {
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database_, "INSERT INTO messages (timestamp, topic_id, data) VALUES (?, ?, ?)", -1,
                       &insert, nullptr);
    sqlite3_bind_int64(insert, 1, timestamp);
    sqlite3_bind_int(insert, 2, topic);
    sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    const int status = sqlite3_step(insert);
    sqlite3_finalize(insert);
    if (status != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database_));
  }

  std::string bytes() const {
    sqlite3_int64 size = 0;
    unsigned char* const data = sqlite3_serialize(database_, "main", &size, 0);
    std::string bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    sqlite3_free(data);
    return bytes;
  }

 private:
  sqlite3* database_ = nullptr;
};

inline std::string cdr_scan(float first_range) {
  ros::LaserScanMessage message;
  message.header = {Time(std::chrono::seconds(100)), "laser"};
  message.scan = {{}, -0.5, 0.5, 0.1, 30.0, {first_range, 2.0F, 3.0F}};
  return ros2::encode_laser_scan(message);
}

inline std::string cdr_odometry(double x) {
  ros::StampedTransform odometry;
  odometry.header = {Time(std::chrono::seconds(100)), "odom"};
  odometry.child_frame_id = "base_link";
  odometry.T_parent_child = ros2::rigid({x, 0.0, 0.0});
  return ros2::encode_odometry(odometry);
}

}  // namespace cairn::test
