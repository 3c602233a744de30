#include "cairn/io/rosbag2_db3.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/byte_stream.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/mcap_records.hpp"
#include "cairn/io/plausible_units.hpp"
#include "cairn/io/ros2_log.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <new>

#include <sqlite3.h>

namespace cairn {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "SQLite format 3\0"sv;
constexpr std::size_t kHeaderBytes = 100;
constexpr int kLongestValue = 256 << 20;
// A bag is read with a few steps of SQLite's machine per row; a hostile schema could make it run for ever.
constexpr int kStepsPerCheck = 1000;
constexpr std::int64_t kChecksPerMebibyte = 1000;

struct Topic {
  std::string name;
  std::string type;
  std::string encoding;
};

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

std::string_view bytes_of(sqlite3_stmt* row, int column) {
  const void* data = sqlite3_column_blob(row, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
  return data == nullptr ? std::string_view() : std::string_view(static_cast<const char*>(data), size);
}

class DatabaseReader {
 public:
  DatabaseReader(std::istream& input, const std::string& name) : name_(name), log_(name) {
    bytes_ = ByteStream(input).read(kMaxInputBytes);
  }

  Log read() {
    open();
    check_is_bag();
    read_topics();
    read_messages();
    Log log = std::move(log_).finish();
    log.format = "rosbag2_db3";
    warn_of_implausible_units(log, name_);
    return log;
  }

 private:
  void open();
  void warn_if_cut();
  void check_is_bag();
  void read_topics();
  void read_messages();
  void take_message(sqlite3_stmt* row);
  Statement prepare(const char* sql);
  bool is_next_row(sqlite3_stmt* statement);
  [[noreturn]] void refuse(const std::string& what) const;

  const std::string& name_;
  std::string bytes_;
  ros2::Ros2Log log_;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
  std::map<std::int64_t, Topic> topics_;
  std::int64_t messages_ = 0;
  std::int64_t checks_left_ = 0;
};

void DatabaseReader::refuse(const std::string& what) const {
  throw InputError(name_, what, "give the .db3 file of a ROS 2 bag");
}

void DatabaseReader::open() {
  if (!is_rosbag2_db3(bytes_)) refuse("is no SQLite database");
  if (bytes_.size() < kHeaderBytes) refuse("is an SQLite database that ends within its header");
  // Bytes 18 and 19: 2 for a database with a write-ahead log. In memory there can be none: read what is here.
  if (bytes_[18] == 2 || bytes_[19] == 2) {
    bytes_[18] = bytes_[19] = 1;
    log_.diagnostics().warn("unfinished", name_,
                            "messages may be missing that lie in a file '-wal' beside it");
  }
  warn_if_cut();
  sqlite3* database = nullptr;
  const int opened = sqlite3_open(":memory:", &database);
  database_.reset(database);
  if (opened != SQLITE_OK) throw std::bad_alloc();
  const auto size = static_cast<sqlite3_int64>(bytes_.size());
  auto* const data = reinterpret_cast<unsigned char*>(bytes_.data());
  if (sqlite3_deserialize(database, "main", data, size, size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) {
    refuse("is an SQLite database that cannot be read");
  }
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLongestValue);
  for (const int trust :
       {SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_TRUSTED_SCHEMA}) {
    sqlite3_db_config(database, trust, 0, nullptr);
  }
  checks_left_ = kChecksPerMebibyte * (1 + (size >> 20));
  const auto is_over = [](void* left) { return --*static_cast<std::int64_t*>(left) < 0 ? 1 : 0; };
  sqlite3_progress_handler(database, kStepsPerCheck, is_over, &checks_left_);
}

// The header tells how many pages there are, if whoever wrote last kept that up to date.
void DatabaseReader::warn_if_cut() {
  const auto number = [&](std::size_t offset, std::size_t size) {
    std::uint64_t value = 0;
    for (const char c : bytes_.substr(offset, size)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  };
  const std::uint64_t page_bytes = number(16, 2) == 1 ? 65536 : number(16, 2);
  const std::uint64_t announced = page_bytes * number(28, 4);
  if (number(24, 4) != number(92, 4) || announced <= bytes_.size()) return;
  log_.diagnostics().warn(
      "truncated", name_,
      "the database is cut short: " + std::to_string(announced - bytes_.size()) + " bytes are missing");
  log_.diagnostics().count("lost bytes", announced - bytes_.size());
}

Statement DatabaseReader::prepare(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr);
  return Statement(statement);
}

bool DatabaseReader::is_next_row(sqlite3_stmt* statement) {
  const int status = statement == nullptr ? sqlite3_errcode(database_.get()) : sqlite3_step(statement);
  if (status == SQLITE_ROW) return true;
  if (status != SQLITE_DONE) {
    log_.diagnostics().warn("damaged database", name_,
                            std::string(sqlite3_errmsg(database_.get())) + "; " + std::to_string(messages_) +
                                " messages were read before it, what follows is lost");
  }
  return false;
}

// Real tables only: a view or a virtual table runs what a stranger wrote.
void DatabaseReader::check_is_bag() {
  const Statement tables = prepare(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('topics', 'messages') AND "
      "rootpage > 0");
  const bool is_read = tables != nullptr && sqlite3_step(tables.get()) == SQLITE_ROW;
  if (!is_read)
    refuse(std::string("is an SQLite database that cannot be read: ") + sqlite3_errmsg(database_.get()));
  if (sqlite3_column_int(tables.get(), 0) != 2)
    refuse("is an SQLite database without the tables of a ROS 2 bag");
}

void DatabaseReader::read_topics() {
  const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
  while (is_next_row(rows.get())) {
    const auto text = [&](int column) { return std::string(bytes_of(rows.get(), column)); };
    topics_[sqlite3_column_int64(rows.get(), 0)] = {text(1), text(2), text(3)};
  }
}

void DatabaseReader::read_messages() {
  const Statement rows = prepare("SELECT topic_id, timestamp, data FROM messages ORDER BY rowid");
  while (is_next_row(rows.get())) take_message(rows.get());
}

void DatabaseReader::take_message(sqlite3_stmt* row) {
  ++messages_;
  const auto topic = topics_.find(sqlite3_column_int64(row, 0));
  if (topic == topics_.end()) {
    return log_.diagnostics().warn("message of an unknown topic", name_,
                                   "message " + std::to_string(messages_));
  }
  const auto& [name, type, encoding] = topic->second;
  const sqlite3_int64 recorded = std::max<sqlite3_int64>(sqlite3_column_int64(row, 1), 0);
  const Time arrival = mcap::from_mcap(static_cast<std::uint64_t>(recorded));
  log_.add({type, name, arrival, bytes_of(row, 2), static_cast<std::uint64_t>(messages_), "message"},
           encoding);
}

}  // namespace

bool is_rosbag2_db3(std::string_view head) { return head.starts_with(kMagic); }

Log read_rosbag2_db3(std::istream& input, const std::string& name) {
  return DatabaseReader(input, name).read();
}

}  // namespace cairn
