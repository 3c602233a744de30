#include "cairn/io/chunk_compression.hpp"

#include <memory>

#include <bzlib.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

namespace cairn {
namespace {

std::string content() {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += std::to_string(i * 7919 % 1000);
  return text;
}

std::string pack_bz2(std::string text) {
  std::string packed(text.size() + text.size() / 50 + 700, '\0');
  auto size = static_cast<unsigned>(packed.size());
  BZ2_bzBuffToBuffCompress(packed.data(), &size, text.data(), static_cast<unsigned>(text.size()), 1, 0, 0);
  return packed.substr(0, size);
}

std::string pack_lz4(const std::string& text) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string packed(LZ4F_compressFrameBound(text.size(), &preferences), '\0');
  return packed.substr(
      0, LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), &preferences));
}

std::string pack_zstd(const std::string& text) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);  // as the zstd tool does
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, 10);    // short blocks
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress2(context.get(), packed.data(), packed.size(), text.data(), text.size()));
  return packed;
}

struct Format {
  const char* name;
  Unpacked (*unpack)(std::string_view, std::size_t);
  std::string packed;
};

class ChunkCompression : public testing::TestWithParam<Format> {
 protected:
  Unpacked unpack(std::string_view packed, std::size_t limit) const {
    return GetParam().unpack(packed, limit);
  }
  const std::string& packed() const { return GetParam().packed; }
  const std::string text = content();
};
INSTANTIATE_TEST_SUITE_P(Formats, ChunkCompression,
                         testing::Values(Format{"bz2", unpack_bz2, pack_bz2(content())},
                                         Format{"lz4", unpack_lz4_frame, pack_lz4(content())},
                                         Format{"zstd", unpack_zstd_frame, pack_zstd(content())}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ChunkCompression, UnpacksWhatWasPacked) {
  const Unpacked result = unpack(packed(), text.size());
  EXPECT_EQ(result.state, UnpackState::kComplete);
  EXPECT_EQ(result.bytes, text);
}

TEST_P(ChunkCompression, NeverUnpacksMoreThanTheLimit) {
  for (std::size_t limit : {std::size_t{0}, std::size_t{1}, text.size() - 1}) {
    const Unpacked result = unpack(packed(), limit);
    EXPECT_EQ(result.state, UnpackState::kCorrupt);
    EXPECT_LE(result.bytes.size(), limit);
  }
}

TEST_P(ChunkCompression, EveryCutGivesAPrefix) {
  for (std::size_t size = 0; size < packed().size(); size += 1 + packed().size() / 500) {
    const Unpacked result = unpack(packed().substr(0, size), text.size());
    EXPECT_EQ(result.state, UnpackState::kCutShort) << size;
    EXPECT_EQ(result.bytes, text.substr(0, result.bytes.size()));
  }
}

// Content of more than one block: the first half is of use when the second is missing.
TEST_P(ChunkCompression, AHalfGivesSomething) {
  EXPECT_GT(unpack(packed().substr(0, packed().size() * 3 / 4), text.size()).bytes.size(), text.size() / 3);
}

TEST_P(ChunkCompression, DamageIsNoticed) {
  for (std::size_t i = 0; i + 8 < packed().size(); i += 1 + packed().size() / 100) {
    std::string damaged = packed();
    for (std::size_t k = i; k < i + 8; ++k) damaged[k] ^= 0x5a;
    const Unpacked result = unpack(damaged, text.size());
    EXPECT_TRUE(result.state != UnpackState::kComplete) << i;
  }
  EXPECT_EQ(unpack("no packed data at all, just text", text.size()).state, UnpackState::kCorrupt);
}

TEST(ChunkPacking, UnpacksToTheSame) {
  for (const std::string& text : {content(), std::string(), std::string("x")}) {
    EXPECT_EQ(unpack_lz4_frame(pack_lz4_frame(text), text.size()).bytes, text);
    EXPECT_EQ(unpack_zstd_frame(pack_zstd_frame(text), text.size()).bytes, text);
  }
  EXPECT_LT(pack_lz4_frame(content()).size(), content().size());
}

}  // namespace
}  // namespace cairn
