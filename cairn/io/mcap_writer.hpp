#pragma once

#include "cairn/io/mcap_records.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::mcap {

enum class Compression : std::uint8_t {
  kNone,
  kLz4,
  kZstd,
  kZstdPictures  ///< fast, and finds what stands twice in a chunk, however large: pictures and their twins
};

/// Makes the bytes of an MCAP file, piece by piece, for whoever stores them.
///
/// Schemas, channels and metadata are written where they are added, messages at end_chunk(): what has been
/// taken up to there is a file that readers recover, should nothing follow. finish() adds the summary and the
/// footer. Chunks below 1 KiB are not compressed.
class Writer {
 public:
  Writer(const Header& header, Compression compression);

  /// @return its id. @throws InputError beyond 65535 of them, as add_channel
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view message_encoding,
                            Texts metadata = {});
  void add_metadata(const Metadata& metadata);
  void add_message(const Message& message);

  /// Bytes of messages that wait for end_chunk().
  std::size_t open_bytes() const { return records_.size(); }
  void end_chunk();
  void finish();

  /// Hands over all bytes made since the last call: they go to the end of the file.
  std::string take();

 private:
  struct IndexEntry {
    std::uint64_t log_time;
    std::uint64_t offset;
  };

  void put(std::string_view record) { bytes_ += record; }
  std::uint64_t offset() const { return taken_ + bytes_.size(); }
  void put_message_indexes(ChunkIndex& index);
  std::string summary(std::uint64_t start) const;

  Compression compression_;
  std::string bytes_;
  std::uint64_t taken_ = 0;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<std::string> metadata_indexes_;
  std::vector<ChunkIndex> chunks_;
  Statistics statistics_;
  std::string records_;  // of the open chunk
  std::uint64_t chunk_start_time_ = 0;
  std::uint64_t chunk_end_time_ = 0;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;  // of the open chunk
};

}  // namespace cairn::mcap
