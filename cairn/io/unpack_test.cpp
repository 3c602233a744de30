#include "cairn/io/unpack.hpp"

#include "cairn/core/errors.hpp"

#include <memory>

#include <bzlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

std::string gzip(const std::string& plain) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, plain.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<unsigned>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<unsigned>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

std::string bzip2(std::string plain) {
  std::string packed(plain.size() + plain.size() / 50 + 700, '\0');
  auto size = static_cast<unsigned>(packed.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(), static_cast<unsigned>(plain.size()),
                                     1, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}

std::string zstd(std::string text) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);  // as the zstd tool does
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress2(context.get(), packed.data(), packed.size(), text.data(), text.size()));
  return packed;
}

struct Format {
  const char* name;
  std::string (*pack)(std::string);
  std::string (*unpack)(std::string_view, const std::string&, std::size_t);
};

constexpr std::size_t kEnough = 1 << 24;

class Unpack : public ::testing::TestWithParam<Format> {
 protected:
  std::string pack(const std::string& plain) const { return GetParam().pack(plain); }
  std::string unpack(const std::string& packed, std::size_t max_bytes = kEnough) const {
    return GetParam().unpack(packed, "a.log", max_bytes);
  }
  std::string error_of(const std::string& packed, std::size_t max_bytes = kEnough) const {
    try {
      unpack(packed, max_bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_P(Unpack, GivesBackWhatWasPacked) {
  std::string plain;
  for (int i = 0; i < 100000; ++i) plain += std::to_string(i * 7919 % 10007) + " ";
  EXPECT_EQ(unpack(pack(plain)), plain);
  EXPECT_EQ(unpack(pack("")), "");
}

TEST_P(Unpack, ReadsOneMemberAfterTheOther) {
  EXPECT_EQ(unpack(pack("one ") + pack("") + pack("two")), "one two");
}

TEST_P(Unpack, CutAtEveryByteIsAnError) {
  const std::string packed = pack("a line of text, and another");
  for (std::size_t size = 0; size < packed.size(); ++size) {
    EXPECT_THAT(error_of(packed.substr(0, size)), HasSubstr("cut short")) << size;
  }
}

TEST_P(Unpack, GarbageBehindIsAnErrorThatSaysWhere) {
  const std::string packed = pack("text");
  EXPECT_THAT(error_of(packed + "garbage"), HasSubstr("(byte " + std::to_string(packed.size()) + ")"));
  EXPECT_THAT(error_of(packed + '\0'), HasSubstr("follows the"));
}

TEST_P(Unpack, DamageIsNoticed) {
  std::string packed = pack("a line of text, and another");
  packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x55);
  EXPECT_NE(error_of(packed), "no error");
}

TEST_P(Unpack, ABombStopsAtTheLimit) {
  const std::string packed = pack(std::string(1 << 22, 'x'));
  ASSERT_LT(packed.size(), 10000U);
  EXPECT_THAT(error_of(packed, 1 << 20), HasSubstr("unpacks to more than 1048576 bytes"));
  EXPECT_EQ(unpack(packed, 1 << 22).size(), 1U << 22);
  EXPECT_THAT(error_of(packed, (1 << 22) - 1), HasSubstr("unpacks to more"));
}

INSTANTIATE_TEST_SUITE_P(Formats, Unpack,
                         ::testing::Values(Format{"gzip", [](std::string s) { return gzip(s); }, unpack_gzip},
                                           Format{"bzip2", bzip2, unpack_bzip2},
                                           Format{"zstd", zstd, unpack_zstd}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(PackingOf, IsToldByTheFirstBytes) {
  EXPECT_EQ(packing_of(gzip("x")), Packing::kGzip);
  EXPECT_EQ(packing_of(bzip2("x")), Packing::kBzip2);
  EXPECT_EQ(packing_of(zstd("x")), Packing::kZstd);
  EXPECT_EQ(packing_of("BZh0"), Packing::kNone);
  EXPECT_EQ(packing_of("FLASER 180"), Packing::kNone);
  EXPECT_EQ(packing_of(""), Packing::kNone);
}

}  // namespace
}  // namespace cairn
