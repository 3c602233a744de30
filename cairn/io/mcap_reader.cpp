#include "cairn/io/mcap_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/chunk_compression.hpp"
#include "cairn/io/input_file.hpp"

#include <optional>
#include <set>
#include <unordered_map>

namespace cairn::mcap {
namespace {

constexpr std::string_view kAnyVersion = "\x89MCAP";

class FileReader {
 public:
  FileReader(std::istream& input, const std::string& name, const Handlers& handlers, Diagnostics& diagnostics)
      : stream_(input), name_(name), handlers_(handlers), diagnostics_(diagnostics) {}

  Header read() {
    read_magic();
    Header header = read_header();
    read_summary();
    read_records();
    report_losses();
    return header;
  }

 private:
  void read_magic();
  Header read_header();
  void read_summary();
  void read_records();
  void report_losses();

  void on_record(Op op, std::string_view content);
  void on_schema(std::string_view content);
  void on_channel(std::string_view content);
  void on_message(std::string_view content);
  void on_metadata(std::string_view content);
  void on_chunk(std::string_view content);
  void read_chunk_records(std::string_view records, bool is_whole);
  Unpacked unpack(const Chunk& chunk) const;
  bool go_on_after_damage();

  void lose(std::uint64_t bytes) {
    if (bytes > 0) diagnostics_.count("lost bytes", bytes);
  }
  void warn(const char* kind, std::uint64_t offset, const std::string& what) {
    diagnostics_.warn(kind, name_ + " (byte offset " + std::to_string(offset) + ")", what);
  }
  void damaged(const std::string& what) { warn("damaged record", stream_.record_offset(), what); }

  RecordStream stream_;
  const std::string& name_;
  const Handlers& handlers_;
  Diagnostics& diagnostics_;
  std::unordered_map<std::uint16_t, Schema> schemas_;
  std::unordered_map<std::uint16_t, Channel> channels_;
  std::set<std::uint64_t> chunk_offsets_;  // as the index tells them
  std::optional<std::uint64_t> announced_messages_;
  std::uint64_t messages_ = 0;
  bool is_closed_ = false;
  bool is_cut_ = false;
};

void FileReader::read_magic() {
  const std::string magic = stream_.bytes(kMagic.size());
  if (magic == kMagic) return;
  if (magic.starts_with(kAnyVersion) && magic.size() == kMagic.size()) {
    throw InputError(name_, "an MCAP file of a version other than 0", "convert it with the mcap tool");
  }
  const bool is_cut = !magic.empty() && kMagic.starts_with(magic);
  throw InputError(name_, is_cut ? "an MCAP file that ends within its first bytes" : "not an MCAP file",
                   is_cut ? "copy it again" : "give a file that begins with \\x89MCAP0");
}

Header FileReader::read_header() {
  const RecordStream::Status status = stream_.next();
  const auto header = parse_header(stream_.content());
  if (status == RecordStream::Status::kRecord && stream_.op() == Op::kHeader && header) return *header;
  throw InputError(name_ + " (byte offset " + std::to_string(kMagic.size()) + ")",
                   "the header of the MCAP file is damaged or cut short", "copy the file again");
}

// Best effort: whatever is wrong with the summary shows when its records are read in their turn.
void FileReader::read_summary() {
  const std::uint64_t here = stream_.offset();
  const std::uint64_t size = stream_.size();
  const std::size_t end_bytes = kFooterBytes + kMagic.size();
  if (size < here + end_bytes || !stream_.seek(size - end_bytes)) return;
  const bool has_footer = stream_.next() == RecordStream::Status::kRecord && stream_.op() == Op::kFooter;
  const auto footer = has_footer ? parse_footer(stream_.content()) : std::nullopt;
  if (footer && footer->summary_start >= here && stream_.seek(footer->summary_start)) {
    while (stream_.next() == RecordStream::Status::kRecord) {
      if (stream_.op() == Op::kChunkIndex) {
        if (const auto index = parse_chunk_index(stream_.content()))
          chunk_offsets_.insert(index->chunk_start_offset);
      } else if (stream_.op() == Op::kStatistics) {
        if (const auto statistics = parse_statistics(stream_.content()))
          announced_messages_ = statistics->message_count;
      }
    }
  }
  CAIRN_ASSERT(stream_.seek(here));
}

void FileReader::read_records() {
  while (true) {
    switch (stream_.next()) {
      case RecordStream::Status::kEnd:
        return;
      case RecordStream::Status::kEndMagic:
        is_closed_ = true;
        return;
      case RecordStream::Status::kRecord:
        if (stream_.op() == Op{}) {
          if (!go_on_after_damage()) return;
        } else {
          on_record(stream_.op(), stream_.content());
        }
        break;
      case RecordStream::Status::kCutShort:
        if (!go_on_after_damage()) return;
        break;
    }
  }
}

void FileReader::on_record(Op op, std::string_view content) {
  switch (op) {
    case Op::kSchema:
      return on_schema(content);
    case Op::kChannel:
      return on_channel(content);
    case Op::kMessage:
      return on_message(content);
    case Op::kChunk:
      return on_chunk(content);
    case Op::kMetadata:
      return on_metadata(content);
    default:  // indexes, attachments, what other programs add: not needed
      return;
  }
}

void FileReader::on_schema(std::string_view content) {
  auto schema = parse_schema(content);
  if (!schema) return damaged("a schema record lacks a field");
  const std::uint16_t id = schema->id;
  schemas_.try_emplace(id, std::move(*schema));  // the summary repeats it
}

void FileReader::on_channel(std::string_view content) {
  auto channel = parse_channel(content);
  if (!channel) return damaged("a channel record lacks a field");
  const std::uint16_t id = channel->id;
  const auto [entry, is_new] = channels_.try_emplace(id, std::move(*channel));
  if (is_new) handlers_.on_channel(schemas_[entry->second.schema_id], entry->second);
}

void FileReader::on_message(std::string_view content) {
  ++messages_;
  const auto message = parse_message(content);
  if (!message) return damaged("a message record lacks a field");
  const auto channel = channels_.find(message->channel_id);
  if (channel == channels_.end()) {
    return warn("message of an unknown channel", stream_.record_offset(),
                "channel " + std::to_string(message->channel_id) + " is not introduced before it");
  }
  handlers_.on_message(
      {schemas_[channel->second.schema_id], channel->second, *message, stream_.record_offset()});
}

void FileReader::on_metadata(std::string_view content) {
  const auto metadata = parse_metadata(content);
  metadata ? handlers_.on_metadata(*metadata) : damaged("a metadata record lacks a field");
}

Unpacked FileReader::unpack(const Chunk& chunk) const {
  if (chunk.uncompressed_size > kMaxChunkBytes) return {};
  if (chunk.compression == "lz4") return unpack_lz4_frame(chunk.records, chunk.uncompressed_size);
  if (chunk.compression == "zstd") return unpack_zstd_frame(chunk.records, chunk.uncompressed_size);
  if (!chunk.compression.empty()) return {};
  const bool is_complete = chunk.records.size() == chunk.uncompressed_size;
  return {std::string(chunk.records), is_complete ? UnpackState::kComplete : UnpackState::kCutShort};
}

void FileReader::on_chunk(std::string_view content) {
  const auto lose_chunk = [&](const std::string& why) {
    warn("corrupt chunk", stream_.record_offset(),
         why + "; " + std::to_string(content.size()) + " bytes lost");
    lose(content.size());
  };
  const bool is_record_whole = stream_.missing_bytes() == 0;
  const auto chunk = parse_chunk(content);
  if (!chunk) return is_record_whole ? lose_chunk("lacks a field") : lose(content.size());
  if (chunk->uncompressed_size > kMaxChunkBytes) {
    return lose_chunk("announces " + std::to_string(chunk->uncompressed_size) + " bytes, more than 256 MiB");
  }
  const Unpacked records = unpack(*chunk);
  const bool is_complete =
      records.state == UnpackState::kComplete && records.bytes.size() == chunk->uncompressed_size;
  if (!is_complete && (is_record_whole || records.state == UnpackState::kCorrupt)) {
    return lose_chunk("does not unpack to what it announces");
  }
  if (is_complete && chunk->uncompressed_crc != 0 && crc32(records.bytes) != chunk->uncompressed_crc) {
    return lose_chunk("has another checksum than it announces");
  }
  read_chunk_records(records.bytes, is_complete);
}

void FileReader::read_chunk_records(std::string_view records, bool is_whole) {
  ByteReader bytes(records);
  while (!bytes.at_end()) {
    const std::size_t begin = bytes.position();
    const auto record = next_record(bytes);
    const bool is_known =
        record && (record->op == Op::kSchema || record->op == Op::kChannel || record->op == Op::kMessage);
    if (is_known) {
      on_record(record->op, record->content);
    } else if (is_whole) {
      return damaged("at byte " + std::to_string(begin) +
                     " of the unpacked chunk; the rest of the chunk is lost");
    }
  }
}

// True if reading goes on with the next chunk that the index knows; else the rest of the file has been taken.
bool FileReader::go_on_after_damage() {
  const std::uint64_t begin = stream_.record_offset();
  const std::uint64_t missing = stream_.missing_bytes();
  const auto next = chunk_offsets_.upper_bound(begin);
  if (next != chunk_offsets_.end() && stream_.seek(*next)) {
    damaged(std::to_string(*next - begin) + " bytes are skipped");
    lose(*next - begin);
    return true;
  }
  if (missing == 0 || missing > kMaxInputBytes) {
    stream_.skip_to_end();
    damaged("no record begins here; the rest of the file is lost");
    lose(stream_.offset() - begin);
    return false;
  }
  is_cut_ = true;
  warn("truncated", stream_.offset(),
       "the file ends within a record: at least " + std::to_string(missing) + " bytes of it are missing");
  lose(missing);
  if (stream_.op() == Op::kChunk) on_chunk(stream_.content());
  return false;
}

void FileReader::report_losses() {
  if (announced_messages_.value_or(0) > messages_) {
    diagnostics_.count("lost messages", *announced_messages_ - messages_);
  }
  if (!is_closed_ && !is_cut_) {
    warn("unfinished", stream_.offset(), "the recording was not closed; read up to here");
  }
}

}  // namespace

bool is_mcap(std::string_view head) { return head.starts_with(kAnyVersion); }

Header read(std::istream& input, const std::string& name, const Handlers& handlers,
            Diagnostics& diagnostics) {
  return FileReader(input, name, handlers, diagnostics).read();
}

}  // namespace cairn::mcap
