#include "cairn/io/mcap_log_writer.hpp"

#include "cairn/core/errors.hpp"

#include <fstream>

namespace cairn {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

}  // namespace

McapLogWriter::McapLogWriter(std::ostream& output, const std::vector<StreamInfo>& streams,
                             mcap::Compression compression)
    : output_(output), writer_(recording_header(), compression), events_(writer_, streams) {}

void McapLogWriter::store() { output_ << writer_.take(); }

void McapLogWriter::add(const Event& event) {
  events_.add(event);
  if (writer_.open_bytes() < kChunkBytes) return;
  writer_.end_chunk();
  store();
}

void McapLogWriter::finish() {
  writer_.finish();
  store();
}

void write_mcap_log(std::ostream& output, const Log& log, mcap::Compression compression) {
  McapLogWriter writer(output, log.streams, compression);
  for (const Event& event : log.events) writer.add(event);
  writer.finish();
}

void write_mcap_log(const std::filesystem::path& path, const Log& log, mcap::Compression compression) {
  std::ofstream file(path, std::ios::binary);
  write_mcap_log(file, log, compression);
  file.close();
  if (!file) {
    throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
  }
}

}  // namespace cairn
