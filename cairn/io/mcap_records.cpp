#include "cairn/io/mcap_records.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <limits>

#include <zlib.h>

namespace cairn::mcap {
namespace {

template <class Record>
std::optional<Record> if_ok(const ByteReader& bytes, Record record) {
  return bytes.ok() ? std::optional(std::move(record)) : std::nullopt;
}

std::string text(ByteReader& bytes) { return std::string(bytes.block()); }

Texts texts(ByteReader& bytes) {
  Texts result;
  ByteReader table(bytes.block());
  while (table.ok() && !table.at_end()) {
    std::string key = text(table);
    std::string value = text(table);
    if (table.ok()) result.emplace(std::move(key), std::move(value));
  }
  return result;
}

Fields& put(Fields& fields, const std::map<std::uint16_t, std::uint64_t>& numbers) {
  constexpr std::size_t kPairBytes = sizeof(std::uint16_t) + sizeof(std::uint64_t);
  fields.number(static_cast<std::uint32_t>(numbers.size() * kPairBytes));
  for (const auto& [key, value] : numbers) fields.number(key).number(value);
  return fields;
}

}  // namespace

// --- parsing: the fields are read in the order of the file, each as wide as it is in the struct -----------

std::optional<Header> parse_header(std::string_view content) {
  ByteReader bytes(content);
  Header header{text(bytes), text(bytes)};
  return if_ok(bytes, std::move(header));
}

std::optional<Schema> parse_schema(std::string_view content) {
  ByteReader bytes(content);
  Schema schema{bytes.number<std::uint16_t>(), text(bytes), text(bytes), text(bytes)};
  return if_ok(bytes, std::move(schema));
}

std::optional<Channel> parse_channel(std::string_view content) {
  ByteReader bytes(content);
  Channel channel{bytes.number<std::uint16_t>(), bytes.number<std::uint16_t>(), text(bytes), text(bytes),
                  texts(bytes)};
  return if_ok(bytes, std::move(channel));
}

std::optional<Message> parse_message(std::string_view content) {
  ByteReader bytes(content);
  Message message{bytes.number<std::uint16_t>(),
                  bytes.number<std::uint32_t>(),
                  bytes.number<std::uint64_t>(),
                  bytes.number<std::uint64_t>(),
                  {}};
  message.data = bytes.take(bytes.remaining());
  return if_ok(bytes, message);
}

std::optional<Metadata> parse_metadata(std::string_view content) {
  ByteReader bytes(content);
  Metadata metadata{text(bytes), texts(bytes)};
  return if_ok(bytes, std::move(metadata));
}

std::optional<Footer> parse_footer(std::string_view content) {
  ByteReader bytes(content);
  const Footer footer{bytes.number<std::uint64_t>(), bytes.number<std::uint64_t>(),
                      bytes.number<std::uint32_t>()};
  return if_ok(bytes, footer);
}

std::optional<Chunk> parse_chunk(std::string_view content) {
  ByteReader bytes(content);
  Chunk chunk{bytes.number<std::uint64_t>(),
              bytes.number<std::uint64_t>(),
              bytes.number<std::uint64_t>(),
              bytes.number<std::uint32_t>(),
              bytes.block(),
              {},
              true};
  const auto size = bytes.number<std::uint64_t>();
  if (!bytes.ok()) return std::nullopt;
  chunk.is_whole = size <= bytes.remaining();
  chunk.records = bytes.take(std::min<std::uint64_t>(size, bytes.remaining()));
  return chunk;
}

std::optional<ChunkIndex> parse_chunk_index(std::string_view content) {
  ByteReader bytes(content);
  ChunkIndex index;
  index.message_start_time = bytes.number<std::uint64_t>();
  index.message_end_time = bytes.number<std::uint64_t>();
  index.chunk_start_offset = bytes.number<std::uint64_t>();
  index.chunk_length = bytes.number<std::uint64_t>();
  return if_ok(bytes, std::move(index));
}

std::optional<Statistics> parse_statistics(std::string_view content) {
  ByteReader bytes(content);
  Statistics statistics;
  statistics.message_count = bytes.number<std::uint64_t>();
  return if_ok(bytes, std::move(statistics));
}

// --- writing ----------------------------------------------------------------------------------------------

Fields& Fields::text(std::string_view text) {
  if (text.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("MCAP", "a text of 4 GiB or more does not fit into a record", "shorten it");
  }
  return number(static_cast<std::uint32_t>(text.size())).raw(text);
}

Fields& Fields::texts(const Texts& texts) {
  Fields table;
  for (const auto& [key, value] : texts) table.text(key).text(value);
  return text(table.bytes());
}

std::string record(Op op, std::string_view content) {
  return Fields()
      .number(static_cast<std::uint8_t>(op))
      .number(std::uint64_t{content.size()})
      .raw(content)
      .bytes();
}

std::string record(const Header& header) {
  return record(Op::kHeader, Fields().text(header.profile).text(header.library).bytes());
}

std::string record(const Schema& schema) {
  return record(Op::kSchema,
                Fields().number(schema.id).text(schema.name).text(schema.encoding).text(schema.data).bytes());
}

std::string record(const Channel& channel) {
  return record(Op::kChannel, Fields()
                                  .number(channel.id)
                                  .number(channel.schema_id)
                                  .text(channel.topic)
                                  .text(channel.message_encoding)
                                  .texts(channel.metadata)
                                  .bytes());
}

std::string record(const Message& message) {
  return record(Op::kMessage, Fields()
                                  .number(message.channel_id)
                                  .number(message.sequence)
                                  .number(message.log_time)
                                  .number(message.publish_time)
                                  .raw(message.data)
                                  .bytes());
}

std::string record(const Chunk& chunk) {
  return record(Op::kChunk, Fields()
                                .number(chunk.message_start_time)
                                .number(chunk.message_end_time)
                                .number(chunk.uncompressed_size)
                                .number(chunk.uncompressed_crc)
                                .text(chunk.compression)
                                .number(std::uint64_t{chunk.records.size()})
                                .raw(chunk.records)
                                .bytes());
}

std::string record(const Metadata& metadata) {
  return record(Op::kMetadata, Fields().text(metadata.name).texts(metadata.values).bytes());
}

std::string record(const ChunkIndex& index) {
  Fields fields;
  fields.number(index.message_start_time).number(index.message_end_time);
  fields.number(index.chunk_start_offset).number(index.chunk_length);
  put(fields, index.message_index_offsets).number(index.message_index_length).text(index.compression);
  fields.number(index.compressed_size).number(index.uncompressed_size);
  return record(Op::kChunkIndex, fields.bytes());
}

std::string record(const Statistics& statistics) {
  constexpr std::uint32_t kAttachments = 0;
  Fields fields;
  fields.number(statistics.message_count).number(statistics.schema_count).number(statistics.channel_count);
  fields.number(kAttachments).number(statistics.metadata_count).number(statistics.chunk_count);
  fields.number(statistics.message_start_time).number(statistics.message_end_time);
  return record(Op::kStatistics, put(fields, statistics.channel_message_counts).bytes());
}

// ----------------------------------------------------------------------------------------------------------

std::uint32_t crc32(std::string_view bytes, std::uint32_t so_far) {
  return static_cast<std::uint32_t>(
      ::crc32_z(so_far, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint64_t to_mcap(Time time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

Time from_mcap(std::uint64_t nanoseconds) {
  return Time(Duration(static_cast<std::int64_t>(std::min<std::uint64_t>(nanoseconds, kLastNanosecond))));
}

RecordStream::Status RecordStream::next() {
  record_offset_ = offset();
  content_.clear();
  op_ = {};
  std::string head = input_.read(kMagic.size());
  if (head.empty()) return Status::kEnd;
  if (head == kMagic) return Status::kEndMagic;
  head += input_.read(kRecordHeadBytes - kMagic.size());
  missing_bytes_ = kRecordHeadBytes - std::min(head.size(), kRecordHeadBytes);
  if (missing_bytes_ > 0) return Status::kCutShort;
  ByteReader fields(head);
  op_ = static_cast<Op>(fields.number<std::uint8_t>());
  const auto size = fields.number<std::uint64_t>();
  content_ = input_.read(size);
  missing_bytes_ = size - content_.size();
  return missing_bytes_ == 0 ? Status::kRecord : Status::kCutShort;
}

std::optional<RecordView> next_record(ByteReader& bytes) {
  const auto op = static_cast<Op>(bytes.number<std::uint8_t>());
  const auto size = bytes.number<std::uint64_t>();
  const std::string_view content = bytes.take(size);
  return bytes.ok() ? std::optional(RecordView{op, content}) : std::nullopt;
}

}  // namespace cairn::mcap
