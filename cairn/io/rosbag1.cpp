#include "cairn/io/rosbag1.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/chunk_compression.hpp"
#include "cairn/io/plausible_units.hpp"
#include "cairn/io/ros1_log.hpp"
#include "cairn/io/rosbag1_records.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace cairn {
namespace {

using namespace rosbag1;

constexpr std::string_view kMagic = "#ROSBAG V";

struct Connection {
  std::string topic;
  std::string type;
  std::string md5sum;
};

// What a chunk held, as it was read and as index records tell.
struct ChunkTally {
  std::uint64_t messages_read = 0;
  std::uint64_t in_index_data = 0;             // records that follow the chunk
  std::optional<std::uint64_t> in_chunk_info;  // records at the end of the bag

  std::uint64_t lost() const {
    const std::uint64_t announced = in_chunk_info.value_or(in_index_data);
    return announced > messages_read ? announced - messages_read : 0;
  }
};

struct BagHeader {
  std::uint64_t index_offset = 0;  // 0: the bag was not closed
  std::uint32_t connections = 0;
  std::uint32_t chunks = 0;
};

class BagReader {
 public:
  BagReader(std::istream& input, const std::string& name) : name_(name), stream_(input), log_(name) {}

  Log read() {
    read_first_line();
    read_bag_header();
    read_index();
    read_records();
    report_losses();
    Log log = std::move(log_).finish();
    log.format = "rosbag1";
    warn_of_implausible_units(log, name_);
    return log;
  }

 private:
  void read_first_line();
  void read_bag_header();
  void read_index();
  void read_records();
  void report_losses();

  void on_record();
  bool take_connection(const RecordView& record);
  bool take_chunk_info(const RecordView& record);
  void on_connection(const RecordView& record);
  void on_chunk_info(const RecordView& record);
  void on_index_data(const RecordView& record);
  void on_chunk(const RecordView& record, bool is_whole);
  void read_chunk_records(std::string_view content, bool is_whole);
  void on_message(const RecordView& record);
  bool go_on_after_damage();
  std::uint64_t next_known_offset(std::uint64_t after) const;

  bool is_truncated() const;
  std::string where(std::uint64_t offset) const;
  void lose_bytes(std::uint64_t bytes) { count("lost bytes", bytes); }
  void count(const char* kind, std::uint64_t n) {
    if (n > 0) log_.diagnostics().count(kind, n);
  }
  void warn(const char* kind, std::uint64_t offset, const std::string& what) {
    log_.diagnostics().warn(kind, where(offset), what);
  }

  const std::string& name_;
  RecordStream stream_;
  ros1::Ros1Log log_;
  BagHeader header_;
  std::unordered_map<std::uint32_t, Connection> connections_;
  std::map<std::uint64_t, ChunkTally> chunks_;  // by offset
  std::uint32_t chunks_seen_ = 0;
  std::uint32_t chunk_infos_seen_ = 0;
  std::uint32_t indexed_connections_seen_ = 0;
  bool ends_within_record_ = false;
};

std::string BagReader::where(std::uint64_t offset) const {
  return name_ + " (byte offset " + std::to_string(offset) + ")";
}

void BagReader::read_first_line() {
  const std::string line = stream_.bytes(kFirstLine.size());
  if (line == kFirstLine) return;
  if (is_rosbag1(line)) {
    throw InputError(name_, "a ROS bag of a format other than 2.0", "convert it with 'rosbag fix'");
  }
  const bool is_cut = !line.empty() && kFirstLine.starts_with(line);
  throw InputError(name_, is_cut ? "a ROS bag that ends within its first line" : "not a ROS 1 bag",
                   is_cut ? "copy it again" : "give a bag of format 2.0, which begins with '#ROSBAG V2.0'");
}

void BagReader::read_bag_header() {
  const bool is_whole = stream_.next() == RecordStream::Status::kRecord;
  const RecordView record = stream_.record();
  const auto index = header_number<std::uint64_t>(record.header, "index_pos");
  const auto connections = header_number<std::uint32_t>(record.header, "conn_count");
  const auto chunks = header_number<std::uint32_t>(record.header, "chunk_count");
  if (!is_whole || header_op(record.header) != Op::kBagHeader || !index || !connections || !chunks) {
    throw InputError(where(kFirstLine.size()), "the bag's header is damaged or cut short",
                     "copy the bag again");
  }
  if (!header_field(record.header, "encryptor").value_or("").empty()) {
    throw InputError(where(kFirstLine.size()), "the bag is encrypted", "decrypt it with 'rosbag decrypt'");
  }
  header_ = {*index, *connections, *chunks};
}

// Best effort: whatever is wrong with the index shows when its records are read in their turn.
void BagReader::read_index() {
  const std::uint64_t here = stream_.offset();
  if (header_.index_offset < here || !stream_.seek(header_.index_offset)) return;
  while (stream_.next() == RecordStream::Status::kRecord) {
    const RecordView record = stream_.record();
    if (header_op(record.header) == Op::kConnection) take_connection(record);
    if (header_op(record.header) == Op::kChunkInfo) take_chunk_info(record);
  }
  CAIRN_ASSERT(stream_.seek(here));
}

void BagReader::read_records() {
  while (true) {
    const RecordStream::Status status = stream_.next();
    if (status == RecordStream::Status::kEnd) return;
    if (status == RecordStream::Status::kRecord) {
      on_record();
    } else if (!go_on_after_damage()) {
      return;
    }
  }
}

void BagReader::on_record() {
  const RecordView record = stream_.record();
  switch (*header_op(record.header)) {
    case Op::kChunk:
      return on_chunk(record, true);
    case Op::kConnection:
      return on_connection(record);
    case Op::kMessage:
      return on_message(record);
    case Op::kIndexData:
      return on_index_data(record);
    case Op::kChunkInfo:
      return on_chunk_info(record);
    case Op::kBagHeader:
      break;
  }
  warn("damaged record", stream_.record_offset(), "a record of an unknown or misplaced kind");
}

bool BagReader::take_connection(const RecordView& record) {
  const auto id = header_number<std::uint32_t>(record.header, "conn");
  const auto topic = header_field(record.header, "topic");
  const auto type = header_field(record.data, "type");  // the data have the same form as a header
  const auto md5sum = header_field(record.data, "md5sum");
  if (!id || !topic || !type || !md5sum) return false;
  connections_[*id] = {std::string(*topic), std::string(*type), std::string(*md5sum)};
  return true;
}

void BagReader::on_connection(const RecordView& record) {
  indexed_connections_seen_ += stream_.record_offset() >= header_.index_offset ? 1 : 0;
  if (take_connection(record)) return;
  warn("damaged record", stream_.record_offset(), "a connection record lacks a field");
}

void BagReader::on_chunk_info(const RecordView& record) {
  ++chunk_infos_seen_;
  if (take_chunk_info(record)) return;
  warn("damaged record", stream_.record_offset(), "a chunk info record lacks a field");
}

bool BagReader::take_chunk_info(const RecordView& record) {
  const auto offset = header_number<std::uint64_t>(record.header, "chunk_pos");
  if (!offset) return false;
  std::uint64_t messages = 0;
  for (ByteReader counts(record.data); counts.remaining() >= 8;) {
    counts.number<std::uint32_t>();  // connection
    messages += counts.number<std::uint32_t>();
  }
  chunks_[*offset].in_chunk_info = messages;
  return true;
}

void BagReader::on_index_data(const RecordView& record) {
  const auto count = header_number<std::uint32_t>(record.header, "count");
  const auto next = chunks_.upper_bound(stream_.record_offset());
  if (count && next != chunks_.begin()) std::prev(next)->second.in_index_data += *count;
}

void BagReader::on_chunk(const RecordView& record, bool is_whole) {
  ++chunks_seen_;
  chunks_.try_emplace(stream_.record_offset());
  const auto lose = [&](const std::string& why) {
    warn("corrupt chunk", stream_.record_offset(),
         why + "; " + std::to_string(record.data.size()) + " bytes lost");
    lose_bytes(record.data.size());
  };
  const std::string compression(header_field(record.header, "compression").value_or("missing"));
  const std::size_t size = header_number<std::uint32_t>(record.header, "size").value_or(0);
  if (size > kMaxChunkBytes) return lose("announces " + std::to_string(size) + " bytes, more than 256 MiB");
  if (compression == "none") {
    if (is_whole && size != record.data.size()) return lose("is not as long as it announces");
    return read_chunk_records(record.data, is_whole);
  }
  if (compression != "bz2" && compression != "lz4") return lose("is packed in an unknown way");
  const Unpacked content =
      compression == "bz2" ? unpack_bz2(record.data, size) : unpack_lz4_frame(record.data, size);
  const bool is_complete = content.state == UnpackState::kComplete && content.bytes.size() == size;
  if (is_complete || (!is_whole && content.state == UnpackState::kCutShort)) {
    return read_chunk_records(content.bytes, is_whole);
  }
  lose("does not unpack to what it announces");
}

void BagReader::read_chunk_records(std::string_view content, bool is_whole) {
  ByteReader bytes(content);
  while (!bytes.at_end()) {
    const std::size_t begin = bytes.position();
    const auto record = next_record(bytes);
    const auto op = record ? header_op(record->header) : std::nullopt;
    if (op == Op::kConnection) {
      on_connection(*record);
    } else if (op == Op::kMessage) {
      on_message(*record);
    } else if (is_whole) {
      warn("damaged record", stream_.record_offset(),
           "at byte " + std::to_string(begin) + " of the unpacked chunk; the rest of the chunk is lost");
      return;
    }
  }
}

void BagReader::on_message(const RecordView& record) {
  const auto chunk = chunks_.find(stream_.record_offset());
  if (chunk != chunks_.end()) ++chunk->second.messages_read;
  const auto id = header_number<std::uint32_t>(record.header, "conn");
  const auto time = header_number<std::uint64_t>(record.header, "time");  // seconds | nanoseconds << 32
  if (!id || !time || *time >> 32 >= 1'000'000'000) {
    return warn("malformed message", stream_.record_offset(), "its record lacks a connection or a time");
  }
  const auto connection = connections_.find(*id);
  if (connection == connections_.end()) {
    return warn("message of an unknown connection", stream_.record_offset(),
                "connection " + std::to_string(*id) + " is not introduced before it");
  }
  const auto& [topic, type, md5sum] = connection->second;
  const Time arrival = ros_time(static_cast<std::uint32_t>(*time), static_cast<std::uint32_t>(*time >> 32));
  log_.add({type, topic, arrival, record.data, stream_.record_offset()}, md5sum);
}

// --- losses
// -------------------------------------------------------------------------------------------------

// Where the index says that something begins; 0 if it knows nothing there.
std::uint64_t BagReader::next_known_offset(std::uint64_t after) const {
  for (auto chunk = chunks_.upper_bound(after); chunk != chunks_.end(); ++chunk) {
    if (chunk->second.in_chunk_info) return chunk->first;
  }
  return header_.index_offset > after ? header_.index_offset : 0;
}

// True if reading goes on with the next chunk known; else the rest of the file has been given up.
bool BagReader::go_on_after_damage() {
  const std::uint64_t begin = stream_.record_offset();
  const std::uint64_t next = next_known_offset(begin);
  const bool is_cut_short = stream_.missing_bytes() > 0;
  if (next > 0 && stream_.seek(next)) {
    warn("damaged record", begin, std::to_string(next - begin) + " bytes are skipped");
    lose_bytes(next - begin);
    return true;
  }
  ends_within_record_ = is_cut_short;
  if (!is_cut_short) {
    stream_.skip_to_end();
    warn("damaged record", begin, "no record begins here; the rest of the bag is lost");
    lose_bytes(stream_.offset() - begin);
    return false;
  }
  const RecordView record = stream_.record();
  if (header_op(record.header) == Op::kChunk && !record.data.empty()) on_chunk(record, false);
  return false;
}

bool BagReader::is_truncated() const {
  if (ends_within_record_) return true;
  if (header_.index_offset == 0) return false;
  return stream_.offset() < header_.index_offset || indexed_connections_seen_ < header_.connections ||
         chunk_infos_seen_ < header_.chunks;
}

void BagReader::report_losses() {
  std::uint64_t messages = 0;
  for (const auto& [offset, tally] : chunks_) messages += tally.lost();
  count("lost messages", messages);
  const std::uint64_t end = stream_.offset();
  if (header_.index_offset == 0) {
    warn("unindexed", end, "the recording was not closed; read up to here");
  }
  if (!is_truncated()) return;
  const std::uint64_t to_index = header_.index_offset > end ? header_.index_offset - end : 0;
  const std::uint64_t missing = std::max(ends_within_record_ ? stream_.missing_bytes() : 0, to_index);
  const std::uint32_t chunks = header_.chunks > chunks_seen_ ? header_.chunks - chunks_seen_ : 0;
  warn("truncated", end,
       "the bag is cut short: at least " + std::to_string(missing) + " bytes and " + std::to_string(chunks) +
           " of " + std::to_string(header_.chunks) + " chunks are missing; copy it again to have them");
  lose_bytes(missing);
}

}  // namespace

bool is_rosbag1(std::string_view head) { return head.starts_with(kMagic); }

Log read_rosbag1(std::istream& input, const std::string& name) { return BagReader(input, name).read(); }

}  // namespace cairn
