#include "cairn/io/mcap_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/chunk_compression.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace cairn::mcap {
namespace {

constexpr std::size_t kLeastPackedBytes = 1024;

struct Packed {
  std::string compression;
  std::string bytes;
};

Packed pack(std::string records, Compression compression) {
  if (compression == Compression::kNone || records.size() < kLeastPackedBytes)
    return {"", std::move(records)};
  if (compression == Compression::kLz4) return {"lz4", pack_lz4_frame(records)};
  const bool pictures = compression == Compression::kZstdPictures;
  return {"zstd", pictures ? pack_zstd_pictures(records) : pack_zstd_frame(records)};
}

std::uint16_t next_id(std::size_t count, const char* what) {
  if (count >= std::numeric_limits<std::uint16_t>::max()) {
    throw InputError("MCAP", std::string("more than 65534 ") + what + " in one file", "write several files");
  }
  return static_cast<std::uint16_t>(count + 1);  // schema 0 means "none"
}

}  // namespace

Writer::Writer(const Header& header, Compression compression) : compression_(compression) {
  put(kMagic);
  put(record(header));
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding, std::string_view data) {
  schemas_.push_back(
      {next_id(schemas_.size(), "schemas"), std::string(name), std::string(encoding), std::string(data)});
  put(record(schemas_.back()));
  return schemas_.back().id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, std::string_view topic,
                                  std::string_view message_encoding, Texts metadata) {
  channels_.push_back({next_id(channels_.size(), "channels"), schema, std::string(topic),
                       std::string(message_encoding), std::move(metadata)});
  put(record(channels_.back()));
  return channels_.back().id;
}

void Writer::add_metadata(const Metadata& metadata) {
  const std::string bytes = record(metadata);
  metadata_indexes_.push_back(
      record(Op::kMetadataIndex,
             Fields().number(offset()).number(std::uint64_t{bytes.size()}).text(metadata.name).bytes()));
  put(bytes);
}

void Writer::add_message(const Message& message) {
  if (records_.empty()) chunk_start_time_ = chunk_end_time_ = message.log_time;
  chunk_start_time_ = std::min(chunk_start_time_, message.log_time);
  chunk_end_time_ = std::max(chunk_end_time_, message.log_time);
  index_[message.channel_id].push_back({message.log_time, records_.size()});
  records_ += record(message);
  Statistics& all = statistics_;
  all.message_start_time =
      all.message_count == 0 ? message.log_time : std::min(all.message_start_time, message.log_time);
  all.message_end_time = std::max(all.message_end_time, message.log_time);
  ++all.message_count;
  ++all.channel_message_counts[message.channel_id];
}

void Writer::end_chunk() {
  if (records_.empty()) return;
  const std::uint64_t start = offset();
  const std::uint64_t size = records_.size();
  const std::uint32_t crc = crc32(records_);
  const Packed packed = pack(std::exchange(records_, {}), compression_);
  put(record(Chunk{chunk_start_time_, chunk_end_time_, size, crc, packed.compression, packed.bytes}));
  ChunkIndex index{chunk_start_time_,  chunk_end_time_,     start, offset() - start, {}, 0,
                   packed.compression, packed.bytes.size(), size};
  put_message_indexes(index);
  chunks_.push_back(std::move(index));
}

void Writer::put_message_indexes(ChunkIndex& index) {
  const std::uint64_t start = offset();
  for (const auto& [channel, entries] : index_) {
    index.message_index_offsets[channel] = offset();
    Fields fields;
    fields.number(channel).number(static_cast<std::uint32_t>(entries.size() * sizeof(IndexEntry)));
    for (const IndexEntry& entry : entries) fields.number(entry.log_time).number(entry.offset);
    put(record(Op::kMessageIndex, fields.bytes()));
  }
  index.message_index_length = offset() - start;
  index_.clear();
}

std::string Writer::summary(std::uint64_t start) const {
  std::string groups;
  std::string offsets;
  const auto put_group = [&](Op op, const std::string& records) {
    if (records.empty()) return;
    const std::uint64_t group_start = start + groups.size();
    offsets += record(Op::kSummaryOffset, Fields()
                                              .number(static_cast<std::uint8_t>(op))
                                              .number(group_start)
                                              .number(std::uint64_t{records.size()})
                                              .bytes());
    groups += records;
  };
  const auto joined = [](const auto& items, const auto& to_record) {
    std::string records;
    for (const auto& item : items) records += to_record(item);
    return records;
  };
  const auto record_of = [](const auto& item) { return record(item); };
  put_group(Op::kSchema, joined(schemas_, record_of));
  put_group(Op::kChannel, joined(channels_, record_of));
  put_group(Op::kStatistics, record(statistics_));
  put_group(Op::kChunkIndex, joined(chunks_, record_of));
  put_group(Op::kMetadataIndex, joined(metadata_indexes_, std::identity()));
  Fields footer;
  footer.number(start).number(start + groups.size());
  const std::string before_crc =
      groups + offsets +
      Fields().number(static_cast<std::uint8_t>(Op::kFooter)).number(std::uint64_t{20}).bytes() +
      footer.bytes();
  return before_crc + Fields().number(crc32(before_crc)).bytes();
}

void Writer::finish() {
  end_chunk();
  statistics_.schema_count = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channel_count = static_cast<std::uint32_t>(channels_.size());
  statistics_.metadata_count = static_cast<std::uint32_t>(metadata_indexes_.size());
  statistics_.chunk_count = static_cast<std::uint32_t>(chunks_.size());
  constexpr std::uint32_t kNoChecksum = 0;
  put(record(Op::kDataEnd, Fields().number(kNoChecksum).bytes()));
  put(summary(offset()));
  put(kMagic);
}

std::string Writer::take() {
  taken_ += bytes_.size();
  return std::exchange(bytes_, {});
}

}  // namespace cairn::mcap
