#include "cairn/io/log_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_log.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/mcap_log.hpp"
#include "cairn/io/mcap_reader.hpp"
#include "cairn/io/mrpt_text_log.hpp"
#include "cairn/io/rosbag1.hpp"
#include "cairn/io/rosbag2_db3.hpp"
#include "cairn/io/text_fields.hpp"
#include "cairn/io/wean_log.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>

namespace cairn {
namespace {

using ReadLog = Log (*)(std::istream&, const std::string&);

constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
constexpr std::size_t kShownBytes = 24;

std::string head_of(std::istream& input) {
  std::string head(kHeadBytes, '\0');
  input.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(input.gcount()));
  input.clear();
  input.seekg(0);
  return head;
}

// The reader of a text log that has a line beginning with this word.
ReadLog reader_of_word(std::string_view word) {
  if (word == "FRAME" || word == "ODO" || word == "BEACON") return read_mrpt_text_log;
  if (word == "O" || word == "L") return read_wean_log;
  if (is_carmen_message(word)) return read_carmen_log;
  return nullptr;
}

// Noise has a line that begins with a reader's one-letter word sooner or later. One byte in nine of it is a
// control character; a text log has none but line ends and tabs, damaged lines aside.
bool is_text(std::string_view head) {
  const auto is_control = [](char c) {
    return (static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r') || c == '\x7f';
  };
  return 20 * std::count_if(head.begin(), head.end(), is_control) <= std::ssize(head);
}

// Decided by the first line that any reader knows: lines before it may be damaged.
ReadLog reader_of_text(const std::string& head, const std::string& name) {
  if (!is_text(head)) return nullptr;
  std::istringstream input(head);
  LineReader line(input, name);
  while (line.next()) {
    FieldReader fields(line);
    if (fields.at_end() || line.line().starts_with('#')) continue;
    if (const ReadLog reader = reader_of_word(fields.word("message name"))) return reader;
  }
  return nullptr;
}

std::string shown(std::string_view bytes) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const char c : bytes.substr(0, kShownBytes)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte <= '~') {
      text += c;
    } else {
      text += {'\\', 'x', kHex[byte / 16], kHex[byte % 16]};
    }
  }
  return text;
}

}  // namespace

Log read_log(std::istream& input, const std::string& name) {
  const std::string head = head_of(input);
  if (is_rosbag1(head)) return read_rosbag1(input, name);
  if (mcap::is_mcap(head)) return read_mcap_log(input, name);
  if (is_rosbag2_db3(head)) return read_rosbag2_db3(input, name);
  if (const ReadLog reader = reader_of_text(head, name)) return reader(input, name);
  throw InputError(name, "is no log of a known format, it begins with \"" + shown(head) + "\"",
                   "give a CARMEN, Wean Hall or MRPT text log, a ROS 1 or ROS 2 bag, or an MCAP file");
}

Log read_log(const std::filesystem::path& path) { return read_log(*open_input(path), path.string()); }

}  // namespace cairn
