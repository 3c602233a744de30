#include "cairn/io/chunk_compression.hpp"

#include "cairn/core/errors.hpp"

#include <array>
#include <memory>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

namespace cairn {
namespace {

using Buffer = std::array<char, std::size_t{64} * 1024>;

class Bz2Decoder {
 public:
  explicit Bz2Decoder(std::string_view packed) : ready_(BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK) {
    stream_.next_in = const_cast<char*>(packed.data());  // libbz2 only reads there
    stream_.avail_in = static_cast<unsigned>(packed.size());
  }
  ~Bz2Decoder() {
    if (ready_) BZ2_bzDecompressEnd(&stream_);
  }
  Bz2Decoder(const Bz2Decoder&) = delete;
  Bz2Decoder& operator=(const Bz2Decoder&) = delete;

  // Fills the buffer as far as it goes; returns how much.
  std::size_t decode(Buffer& buffer) {
    stream_.next_out = buffer.data();
    stream_.avail_out = static_cast<unsigned>(buffer.size());
    status_ = ready_ ? BZ2_bzDecompress(&stream_) : BZ_MEM_ERROR;
    return buffer.size() - stream_.avail_out;
  }
  bool finished() const { return status_ == BZ_STREAM_END; }
  bool failed() const { return status_ != BZ_OK && status_ != BZ_STREAM_END; }
  bool starved() const { return stream_.avail_in == 0; }

 private:
  bz_stream stream_{};
  bool ready_;
  int status_ = BZ_OK;
};

class Lz4Decoder {
 public:
  explicit Lz4Decoder(std::string_view packed) : packed_(packed) {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) == 0) context_.reset(context);
  }

  std::size_t decode(Buffer& buffer) {
    if (!context_) return 0;
    std::size_t out = buffer.size();
    std::size_t in = packed_.size();
    hint_ = LZ4F_decompress(context_.get(), buffer.data(), &out, packed_.data(), &in, nullptr);
    if (failed()) return 0;
    packed_.remove_prefix(in);
    return out;
  }
  bool finished() const { return hint_ == 0; }
  bool failed() const { return !context_ || LZ4F_isError(hint_) != 0; }
  bool starved() const { return packed_.empty(); }

 private:
  struct Free {
    void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
  };
  std::string_view packed_;
  std::unique_ptr<LZ4F_dctx, Free> context_;
  std::size_t hint_ = 1;
};

class ZstdDecoder {
 public:
  explicit ZstdDecoder(std::string_view packed)
      : in_{packed.data(), packed.size(), 0}, context_(ZSTD_createDCtx()) {}

  std::size_t decode(Buffer& buffer) {
    if (!context_) return 0;
    ZSTD_outBuffer out{buffer.data(), buffer.size(), 0};
    hint_ = ZSTD_decompressStream(context_.get(), &out, &in_);
    return failed() ? 0 : out.pos;
  }
  bool finished() const { return hint_ == 0; }
  bool failed() const { return !context_ || ZSTD_isError(hint_) != 0; }
  bool starved() const { return in_.pos == in_.size; }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  ZSTD_inBuffer in_;
  std::unique_ptr<ZSTD_DCtx, Free> context_;
  std::size_t hint_ = 1;
};

template <class Decoder>
Unpacked unpack(Decoder decoder, std::size_t limit) {
  Unpacked result;
  const auto buffer = std::make_unique<Buffer>();
  while (true) {
    const std::size_t size = decoder.decode(*buffer);
    if (decoder.failed() || size > limit - result.bytes.size()) return result;
    result.bytes.append(buffer->data(), size);
    const bool stuck = size == 0 && !decoder.finished();
    if (stuck && !decoder.starved()) return result;
    if (stuck || decoder.finished()) break;
  }
  result.state = decoder.finished() ? UnpackState::kComplete : UnpackState::kCutShort;
  return result;
}

}  // namespace

Unpacked unpack_bz2(std::string_view packed, std::size_t limit) { return unpack(Bz2Decoder(packed), limit); }

Unpacked unpack_lz4_frame(std::string_view packed, std::size_t limit) {
  return unpack(Lz4Decoder(packed), limit);
}

Unpacked unpack_zstd_frame(std::string_view packed, std::size_t limit) {
  return unpack(ZstdDecoder(packed), limit);
}

std::string pack_lz4_frame(std::string_view bytes) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentSize = bytes.size();
  std::string packed(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &preferences);
  CAIRN_ASSERT(LZ4F_isError(size) == 0);
  packed.resize(size);
  return packed;
}

std::string pack_zstd_frame(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
  CAIRN_ASSERT(ZSTD_isError(size) == 0);
  packed.resize(size);
  return packed;
}

std::string pack_zstd_pictures(std::string_view bytes) {
  constexpr int kFast = 1, kWindowBits = 22;
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  CAIRN_ASSERT(context);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kFast);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, kWindowBits);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_enableLongDistanceMatching, 1);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
  CAIRN_ASSERT(ZSTD_isError(size) == 0);
  packed.resize(size);
  return packed;
}

}  // namespace cairn
