#include "cairn/io/unpack.hpp"
#include "fuzz_target.hpp"

namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string packed = cairn::fuzz::text_of(data, size);
  for (const auto& unpack : {cairn::unpack_gzip, cairn::unpack_bzip2, cairn::unpack_zstd}) {
    cairn::fuzz::read_stream(data, size, [&](std::istream&) {
      if (unpack(packed, "fuzz", kMaxBytes).size() > kMaxBytes)
        throw std::logic_error("more than was allowed");
    });
  }
  return 0;
}
