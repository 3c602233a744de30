#include "cairn/io/png.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string_view>

#include <png.h>

namespace cairn {
namespace {

// libpng leaves by longjmp, which must not pass over objects that have a destructor: every function below
// that calls setjmp holds plain pointers only, and everything owned lives in PngFile.

constexpr std::size_t kMaxDeflateRatio = 1032;  // one bit codes at most 258 bytes (RFC 1951)
constexpr std::size_t kMaxMessage = 120;

struct PngFile {
  std::string_view bytes;            // to read
  std::string written;               // to write
  std::size_t packed_row_bytes = 0;  // before any expansion to 8 bits
  char message[kMaxMessage] = "";
  png_structp png = nullptr;
  png_infop info = nullptr;
  bool writes = false;

  ~PngFile() {
    if (writes) png_destroy_write_struct(&png, &info);
    if (!writes) png_destroy_read_struct(&png, &info, nullptr);
  }
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  auto* file = static_cast<PngFile*>(png_get_error_ptr(png));
  std::strncpy(file->message, text, kMaxMessage - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* file = static_cast<PngFile*>(png_get_io_ptr(png));
  if (count > file->bytes.size()) png_error(png, "the file ends early");
  std::memcpy(out, file->bytes.data(), count);
  file->bytes.remove_prefix(count);
}

void put_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  static_cast<PngFile*>(png_get_io_ptr(png))->written.append(reinterpret_cast<const char*>(bytes), count);
}

void flush_nothing(png_structp) {}

bool read_header(PngFile& file) {
  if (setjmp(png_jmpbuf(file.png))) return false;
  png_set_read_fn(file.png, &file, take_bytes);
  png_set_user_limits(file.png, 1u << 30, 1u << 30);
  png_read_info(file.png, file.info);
  file.packed_row_bytes = png_get_rowbytes(file.png, file.info);
  png_set_scale_16(file.png);
  png_set_palette_to_rgb(file.png);
  png_set_expand_gray_1_2_4_to_8(file.png);
  if (png_get_valid(file.png, file.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(file.png);
  png_set_interlace_handling(file.png);
  png_read_update_info(file.png, file.info);
  return true;
}

// Channels are grey, grey + opacity, red green blue, or red green blue + opacity.
struct GrayRows {
  std::size_t channels;
  std::size_t width;
  std::uint8_t* gray;
  std::uint8_t* opacity;  // null for none

  void add(const std::uint8_t* samples) {
    for (std::size_t i = 0; i < width; ++i, samples += channels) {
      *gray++ = channels < 3 ? samples[0]
                             : static_cast<std::uint8_t>((samples[0] + samples[1] + samples[2] + 1) / 3);
      if (opacity) *opacity++ = samples[channels - 1];
    }
  }
};

// An interlaced picture must be unpacked whole (`rows` has all of them); any other goes through one row.
bool read_pixels(PngFile& file, png_bytepp rows, std::size_t height, bool interlaced, GrayRows* out) {
  if (setjmp(png_jmpbuf(file.png))) return false;
  if (interlaced) png_read_image(file.png, rows);
  for (std::size_t row = 0; row < height; ++row) {
    if (!interlaced) png_read_row(file.png, rows[0], nullptr);
    out->add(rows[interlaced ? row : 0]);
  }
  png_read_end(file.png, nullptr);
  return true;
}

bool write_all(PngFile& file, int width, int height, png_bytepp rows) {
  if (setjmp(png_jmpbuf(file.png))) return false;
  png_set_write_fn(file.png, &file, put_bytes, flush_nothing);
  png_set_IHDR(file.png, file.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(file.png, file.info);
  png_write_image(file.png, rows);
  png_write_end(file.png, nullptr);
  return true;
}

std::vector<png_bytep> row_pointers(std::uint8_t* pixels, std::size_t row_bytes, int height) {
  std::vector<png_bytep> rows(static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = pixels + i * row_bytes;
  return rows;
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name, what, "check the picture with another program");
}

}  // namespace

GrayImage read_png(const std::string& bytes, const std::string& name) {
  PngFile file;
  file.bytes = bytes;
  file.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &file, on_error, on_warning);
  if (file.png) file.info = png_create_info_struct(file.png);
  if (!file.info) throw std::bad_alloc();
  if (!read_header(file)) refuse(name, std::string("is no readable PNG: ") + file.message);
  const std::size_t width = png_get_image_width(file.png, file.info);
  const std::size_t height = png_get_image_height(file.png, file.info);
  const std::size_t row_bytes = png_get_rowbytes(file.png, file.info);
  if (width * height > kMaxCells || file.packed_row_bytes * height > kMaxDeflateRatio * bytes.size()) {
    refuse(name, "announces " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, more than it can hold");
  }
  GrayImage image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  const std::size_t channels = png_get_channels(file.png, file.info);
  image.gray.resize(image.size());
  if (channels % 2 == 0) image.opacity.resize(image.size());
  GrayRows out{channels, width, image.gray.data(), image.opacity.empty() ? nullptr : image.opacity.data()};
  const bool interlaced = png_get_interlace_type(file.png, file.info) != PNG_INTERLACE_NONE;
  std::vector<std::uint8_t> samples(row_bytes * (interlaced ? height : 1));
  auto rows = row_pointers(samples.data(), row_bytes, interlaced ? image.height : 1);
  if (!read_pixels(file, rows.data(), height, interlaced, &out)) {
    refuse(name, std::string("is a damaged PNG: ") + file.message);
  }
  return image;
}

void write_png(std::ostream& output, const GrayImage& image) {
  CAIRN_ASSERT(image.gray.size() == image.size());
  PngFile file;
  file.writes = true;
  file.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &file, on_error, on_warning);
  if (file.png) file.info = png_create_info_struct(file.png);
  if (!file.info) throw std::bad_alloc();
  std::vector<std::uint8_t> pixels = image.gray;
  auto rows = row_pointers(pixels.data(), static_cast<std::size_t>(image.width), image.height);
  if (!write_all(file, image.width, image.height, rows.data())) refuse("PNG", file.message);
  output << file.written;
}

}  // namespace cairn
