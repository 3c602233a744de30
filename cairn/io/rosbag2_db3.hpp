#pragma once

#include "cairn/io/log.hpp"

#include <istream>
#include <string>
#include <string_view>

namespace cairn {

/// True if a file that begins with `head` (16 bytes are enough) is an SQLite database.
bool is_rosbag2_db3(std::string_view head);

/// Reads a ROS 2 bag in the SQLite form (.db3): tables `topics` and `messages`, CDR. See ros2::Ros2Log for
/// which messages become which streams. Messages come in the order of their rows, as they were recorded.
///
/// A database that is damaged is read up to the first page that SQLite refuses (counted as "damaged
/// database"), also one that is cut short (counted as "truncated", with the bytes that are missing). The last
/// messages of a recording that was not closed lie in a file `-wal` beside it, which is not looked at
/// (counted as "unfinished").
/// @param name  of the file, for messages to the user
/// @throws InputError if it is no SQLite database or holds no ROS 2 bag
Log read_rosbag2_db3(std::istream& input, const std::string& name);

}  // namespace cairn
