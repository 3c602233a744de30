#include "cairn/io/pgm.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <charconv>

namespace cairn {
namespace {

constexpr int kMaxSample = 65535;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Walks over the bytes of a PGM file.
class PgmReader {
 public:
  PgmReader(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  GrayImage read() {
    const bool plain = bytes_.starts_with("P2");
    if (!plain && !bytes_.starts_with("P5")) fail("does not begin with P2 or P5", "name a PGM picture");
    position_ = 2;
    GrayImage image;
    image.width = number("width", 1, 1 << 30);
    image.height = number("height", 1, 1 << 30);
    max_ = number("maximum value", 1, kMaxSample);
    expect_room(image, plain);
    image.gray.reserve(image.size());
    plain ? read_plain(image) : read_raw(image);
    expect_end();
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError(name_ + " (byte " + std::to_string(position_) + ")", what, remedy);
  }

  void skip_space_and_comments() {
    while (position_ < bytes_.size() && (is_space(bytes_[position_]) || bytes_[position_] == '#')) {
      if (bytes_[position_] == '#') position_ = std::min(bytes_.find('\n', position_), bytes_.size() - 1);
      ++position_;
    }
  }

  int number(const char* meaning, int min, int max) {
    skip_space_and_comments();
    int value = 0;
    const char* const end = bytes_.data() + bytes_.size();
    const auto [stop, error] = std::from_chars(bytes_.data() + position_, end, value);
    if (error == std::errc::invalid_argument)
      fail(std::string("no number where the ") + meaning + " belongs", "");
    if (error != std::errc() || value < min || value > max) {
      fail(std::string(meaning) + " is not within " + std::to_string(min) + ".." + std::to_string(max), "");
    }
    position_ = static_cast<std::size_t>(stop - bytes_.data());
    return value;
  }

  // Before anything is allocated: a pixel takes at least two bytes as text, one or two raw.
  void expect_room(const GrayImage& image, bool plain) {
    const std::size_t bytes_per_pixel = plain || max_ > 255 ? 2 : 1;
    const std::size_t left = bytes_.size() - position_;
    if (image.size() > kMaxCells || image.size() * bytes_per_pixel > left + 1) {
      fail("announces " + std::to_string(image.width) + " x " + std::to_string(image.height) +
               " pixels, the file holds " + std::to_string(left) + " bytes of them",
           "check for a cut file");
    }
  }

  void read_plain(GrayImage& image) {
    for (std::size_t i = 0; i < image.size(); ++i) image.gray.push_back(to_8_bits(number("pixel", 0, max_)));
  }

  void read_raw(GrayImage& image) {
    const std::size_t bytes_per_pixel = max_ > 255 ? 2 : 1;
    if (position_ >= bytes_.size() || !is_space(bytes_[position_]))
      fail("no white space before the pixels", "");
    ++position_;
    if (bytes_.size() - position_ < image.size() * bytes_per_pixel)
      fail("the file ends early", "check for a cut file");
    for (std::size_t i = 0; i < image.size(); ++i)
      image.gray.push_back(to_8_bits(raw_sample(bytes_per_pixel)));
  }

  int raw_sample(std::size_t bytes_per_pixel) {
    int value = 0;
    for (std::size_t i = 0; i < bytes_per_pixel; ++i) {
      value = 256 * value + static_cast<unsigned char>(bytes_[position_ + i]);
    }
    if (value > max_) fail("a pixel exceeds the maximum value " + std::to_string(max_), "");
    position_ += bytes_per_pixel;
    return value;
  }

  std::uint8_t to_8_bits(int value) const {
    return static_cast<std::uint8_t>((value * 255 + max_ / 2) / max_);
  }

  void expect_end() {
    while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
    if (position_ < bytes_.size()) fail("more follows than the announced pixels", "check width and height");
  }

  const std::string& bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
  int max_ = 0;
};

}  // namespace

GrayImage read_pgm(const std::string& bytes, const std::string& name) {
  return PgmReader(bytes, name).read();
}

void write_pgm(std::ostream& output, const GrayImage& image) {
  output << "P5\n" << image.width << ' ' << image.height << "\n255\n";
  output.write(reinterpret_cast<const char*>(image.gray.data()),
               static_cast<std::streamsize>(image.gray.size()));
}

}  // namespace cairn
