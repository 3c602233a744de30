#include "cairn/io/mcap_log_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/event_writer.hpp"

#include <fstream>

namespace cairn {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

}  // namespace

void write_mcap_log(std::ostream& output, const Log& log, mcap::Compression compression) {
  mcap::Writer writer(recording_header(), compression);
  EventWriter events(writer, log.streams);
  for (const Event& event : log.events) {
    events.add(event);
    if (writer.open_bytes() < kChunkBytes) continue;
    writer.end_chunk();
    output << writer.take();
  }
  writer.finish();
  output << writer.take();
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
