#pragma once

#include "cairn/core/time.hpp"
#include "cairn/io/byte_reader.hpp"
#include "cairn/io/byte_stream.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The container MCAP (https://mcap.dev/spec), version 0: magic bytes, records of `<uint8 opcode><uint64 n>
/// <content: n bytes>`, magic bytes again. All little-endian; a text or a table is led by its length in bytes
/// (uint32). This header has the records, mcap_reader.hpp and mcap_writer.hpp the files.
namespace cairn::mcap {

inline constexpr std::string_view kMagic = "\x89MCAP0\r\n";
inline constexpr std::size_t kRecordHeadBytes = 1 + sizeof(std::uint64_t);
inline constexpr std::size_t kMaxChunkBytes = std::size_t{256} << 20;  ///< unpacked; writers use 1 to 4 MiB

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0a,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

using Texts = std::map<std::string, std::string>;

struct Header {
  std::string profile;
  std::string library;
};

struct Schema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;
  Texts metadata;
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  std::string_view data;
};

struct Chunk {
  std::uint64_t message_start_time = 0;
  std::uint64_t message_end_time = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not computed
  std::string_view compression;        ///< "", "lz4" or "zstd"
  std::string_view records;            ///< packed; shorter than announced if the file ends within them
  bool is_whole = true;
};

struct Metadata {
  std::string name;
  Texts values;
};

struct ChunkIndex {
  std::uint64_t message_start_time = 0;
  std::uint64_t message_end_time = 0;
  std::uint64_t chunk_start_offset = 0;
  std::uint64_t chunk_length = 0;
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t message_start_time = 0;
  std::uint64_t message_end_time = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

struct Footer {
  std::uint64_t summary_start = 0;  ///< 0: there is no summary
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};
inline constexpr std::size_t kFooterBytes = kRecordHeadBytes + 8 + 8 + 4;

// Each of these takes the content of its record; nullopt if that ends before its last field.
std::optional<Header> parse_header(std::string_view content);
std::optional<Schema> parse_schema(std::string_view content);
std::optional<Channel> parse_channel(std::string_view content);
std::optional<Message> parse_message(std::string_view content);
std::optional<Metadata> parse_metadata(std::string_view content);
std::optional<Footer> parse_footer(std::string_view content);
/// Also the first part of a chunk, as long as its own fields are there: then is_whole is false.
std::optional<Chunk> parse_chunk(std::string_view content);
/// Of these two only what a reader needs: where the chunk begins, and the number of messages.
std::optional<ChunkIndex> parse_chunk_index(std::string_view content);
std::optional<Statistics> parse_statistics(std::string_view content);

/// Appends fields to the content of a record.
class Fields {
 public:
  template <class Number>
  Fields& number(Number value) {
    static_assert(std::is_integral_v<Number>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// @throws InputError for 4 GiB and more
  Fields& text(std::string_view text);
  Fields& texts(const Texts& texts);
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// The whole record, ready to be written.
std::string record(Op op, std::string_view content);
std::string record(const Header& header);
std::string record(const Schema& schema);
std::string record(const Channel& channel);
std::string record(const Message& message);
std::string record(const Chunk& chunk);
std::string record(const Metadata& metadata);
std::string record(const ChunkIndex& index);
std::string record(const Statistics& statistics);

std::uint32_t crc32(std::string_view bytes, std::uint32_t so_far = 0);

/// MCAP counts nanoseconds from 0 (uint64); Cairn's time may be negative. Times are kept within 2^62 ns of
/// zero (the year 2116), so that the difference of any two can be told; beyond, the nearest.
inline constexpr std::int64_t kLastNanosecond = (std::int64_t{1} << 62) - 1;
std::uint64_t to_mcap(Time time);
Time from_mcap(std::uint64_t nanoseconds);

/// Reads the records of a file one by one, after the magic bytes.
class RecordStream {
 public:
  enum class Status {
    kRecord,
    kEnd,       ///< the stream ended between two records
    kCutShort,  ///< the stream ended within a record: content() holds what was there
    kEndMagic   ///< the magic bytes at the end of a file
  };

  explicit RecordStream(std::istream& input) : input_(input) {}

  std::string bytes(std::size_t size) { return input_.read(size); }
  Status next();
  Op op() const { return op_; }
  std::string_view content() const { return content_; }
  std::uint64_t record_offset() const { return record_offset_; }  ///< where the last record began
  std::uint64_t missing_bytes() const { return missing_bytes_; }  ///< kCutShort: at least so many are lost

  std::uint64_t offset() const { return input_.offset(); }
  bool seek(std::uint64_t offset) { return input_.seek(offset); }
  std::uint64_t size() { return input_.size(); }
  void skip_to_end() { input_.skip_to_end(); }

 private:
  ByteStream input_;
  std::uint64_t record_offset_ = 0;
  std::uint64_t missing_bytes_ = 0;
  Op op_{};
  std::string content_;
};

/// Takes the next record of an unpacked chunk; nullopt if the bytes end within it (then `bytes` is not ok).
struct RecordView {
  Op op;
  std::string_view content;
};
std::optional<RecordView> next_record(ByteReader& bytes);

}  // namespace cairn::mcap
