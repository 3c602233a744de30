#include "cairn/io/gray_image.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/pgm.hpp"
#include "cairn/io/png.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string_view>

namespace cairn {
namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

bool is_netpbm(const std::string& bytes) {
  return bytes.size() >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
         std::isspace(static_cast<unsigned char>(bytes[2]));
}

}  // namespace

std::string read_rest(std::istream& input) { return {std::istreambuf_iterator<char>(input), {}}; }

bool looks_like_image(const std::string& first_bytes) {
  constexpr std::array<std::string_view, 6> kSignatures = {kPngSignature, "\xff\xd8\xff", "BM",
                                                           "II*",         "MM",           "GIF8"};
  return is_netpbm(first_bytes) || std::any_of(kSignatures.begin(), kSignatures.end(), [&](auto signature) {
           return first_bytes.starts_with(signature);
         });
}

GrayImage read_image(std::istream& input, const std::string& name) {
  const std::string bytes = read_rest(input);
  if (bytes.starts_with(kPngSignature)) return read_png(bytes, name);
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return read_pgm(bytes, name);
  throw InputError(name, "is neither PNG nor PGM", "convert it, for example: convert map.bmp map.png");
}

}  // namespace cairn
