#include "cairn/io/unpack.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

#include <bzlib.h>
#include <zlib.h>
#include <zstd.h>

namespace cairn {
namespace {

// zlib and libbz2 count in 32 bits: larger input goes to them in slices.
constexpr std::size_t kSliceBytes = std::size_t{1} << 30;
constexpr std::size_t kFirstOutputBytes = std::size_t{1} << 16;

enum class Step { kProgress, kMemberEnd, kDamaged };

/// Growing output that ends at a limit.
class Output {
 public:
  explicit Output(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  bool full() const { return size_ > max_bytes_; }
  /// Room for at least one more byte: one more than the limit, so that going beyond it is noticed.
  void make_room() {
    if (size_ < bytes_.size()) return;
    bytes_.resize(std::min(std::max(kFirstOutputBytes, 2 * bytes_.size()), max_bytes_ + 1));
  }
  char* end() { return bytes_.data() + size_; }
  unsigned room() const { return static_cast<unsigned>(std::min(bytes_.size() - size_, kSliceBytes)); }
  void advance(std::size_t n) { size_ += n; }
  std::size_t size() const { return size_; }
  std::string take() {
    bytes_.resize(size_);
    return std::move(bytes_);
  }

 private:
  std::size_t max_bytes_;
  std::size_t size_ = 0;
  std::string bytes_;
};

class Gunzip {
 public:
  static constexpr const char* kFormat = "gzip";
  static bool starts_member(std::string_view bytes) { return packing_of(bytes) == Packing::kGzip; }

  Gunzip() {
    constexpr int kGzipOnly = 15 + 16;  // largest window, gzip header
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  ~Gunzip() { inflateEnd(&stream_); }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  void restart() { inflateReset(&stream_); }

  /// Reads from the front of `in`, which it shortens, and writes to `out`.
  Step step(std::string_view& in, Output& out) {
    const auto given = static_cast<unsigned>(std::min(in.size(), kSliceBytes));
    // zlib does not write to its input; its C interface says so only when ZLIB_CONST is defined.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    stream_.avail_in = given;
    stream_.next_out = reinterpret_cast<Bytef*>(out.end());
    stream_.avail_out = out.room();
    const int status = inflate(&stream_, Z_NO_FLUSH);
    out.advance(out.room() - stream_.avail_out);
    in.remove_prefix(given - stream_.avail_in);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) return Step::kMemberEnd;
    return status == Z_OK || status == Z_BUF_ERROR ? Step::kProgress : Step::kDamaged;
  }

 private:
  z_stream stream_{};
};

class Bunzip2 {
 public:
  static constexpr const char* kFormat = "bzip2";
  static bool starts_member(std::string_view bytes) { return packing_of(bytes) == Packing::kBzip2; }

  Bunzip2() { start(); }
  ~Bunzip2() { BZ2_bzDecompressEnd(&stream_); }
  Bunzip2(const Bunzip2&) = delete;
  Bunzip2& operator=(const Bunzip2&) = delete;

  void restart() {
    BZ2_bzDecompressEnd(&stream_);
    start();
  }

  Step step(std::string_view& in, Output& out) {
    const auto given = static_cast<unsigned>(std::min(in.size(), kSliceBytes));
    stream_.next_in = const_cast<char*>(in.data());  // a C interface: it only reads
    stream_.avail_in = given;
    stream_.next_out = out.end();
    stream_.avail_out = out.room();
    const int status = BZ2_bzDecompress(&stream_);
    out.advance(out.room() - stream_.avail_out);
    in.remove_prefix(given - stream_.avail_in);
    if (status == BZ_MEM_ERROR) throw std::bad_alloc();
    if (status == BZ_STREAM_END) return Step::kMemberEnd;
    return status == BZ_OK ? Step::kProgress : Step::kDamaged;
  }

 private:
  void start() {
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  bz_stream stream_{};
};

class Unzstd {
 public:
  static constexpr const char* kFormat = "Zstandard";
  static bool starts_member(std::string_view bytes) { return packing_of(bytes) == Packing::kZstd; }

  Unzstd() : context_(ZSTD_createDCtx()) {
    if (!context_) throw std::bad_alloc();
  }

  void restart() { ZSTD_DCtx_reset(context_.get(), ZSTD_reset_session_only); }

  Step step(std::string_view& in, Output& out) {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out.end(), out.room(), 0};
    const std::size_t status = ZSTD_decompressStream(context_.get(), &to, &from);
    out.advance(to.pos);
    in.remove_prefix(from.pos);
    if (ZSTD_isError(status) != 0) return Step::kDamaged;
    return status == 0 ? Step::kMemberEnd : Step::kProgress;
  }

 private:
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  std::unique_ptr<ZSTD_DCtx, Free> context_;
};

/// Unpacks all members, each step checked.
template <typename Unpacker>
class Unpacking {
 public:
  Unpacking(std::string_view packed, const std::string& name, std::size_t max_bytes)
      : packed_(packed), in_(packed), name_(name), max_bytes_(max_bytes), out_(max_bytes) {}

  std::string run() {
    while (!in_.empty() || !member_ended_) {
      if (member_ended_) start_next_member();
      advance();
    }
    return out_.take();
  }

 private:
  void advance() {
    out_.make_room();
    const std::size_t in_before = in_.size();
    const std::size_t out_before = out_.size();
    const Step step = unpacker_.step(in_, out_);
    if (step == Step::kDamaged) stop("damaged " + kFormat + " data", "fetch or pack the file again");
    if (out_.full()) stop("unpacks to more than " + std::to_string(max_bytes_) + " bytes", "split the file");
    member_ended_ = step == Step::kMemberEnd;
    const bool stuck = in_.size() == in_before && out_.size() == out_before;
    if (stuck && !member_ended_) stop(kFormat + " data is cut short", "fetch the whole file again");
  }

  void start_next_member() {
    if (!Unpacker::starts_member(in_)) {
      stop("something that is not " + kFormat + " follows the " + kFormat + " data",
           "fetch or pack the file again");
    }
    unpacker_.restart();
  }

  [[noreturn]] void stop(const std::string& what, const std::string& remedy) const {
    const std::size_t offset = packed_.size() - in_.size();
    throw InputError(name_ + " (byte " + std::to_string(offset) + ")", what, remedy);
  }

  const std::string kFormat = Unpacker::kFormat;
  std::string_view packed_;
  std::string_view in_;
  const std::string& name_;
  std::size_t max_bytes_;
  Output out_;
  Unpacker unpacker_;
  bool member_ended_ = false;
};

}  // namespace

Packing packing_of(std::string_view bytes) {
  if (bytes.starts_with("\x1f\x8b")) return Packing::kGzip;
  if (bytes.size() >= 4 && bytes.starts_with("BZh") && bytes[3] >= '1' && bytes[3] <= '9')
    return Packing::kBzip2;
  if (bytes.starts_with("\x28\xb5\x2f\xfd")) return Packing::kZstd;
  return Packing::kNone;
}

std::string unpack_gzip(std::string_view packed, const std::string& name, std::size_t max_bytes) {
  return Unpacking<Gunzip>(packed, name, max_bytes).run();
}

std::string unpack_bzip2(std::string_view packed, const std::string& name, std::size_t max_bytes) {
  return Unpacking<Bunzip2>(packed, name, max_bytes).run();
}

std::string unpack_zstd(std::string_view packed, const std::string& name, std::size_t max_bytes) {
  return Unpacking<Unzstd>(packed, name, max_bytes).run();
}

}  // namespace cairn
