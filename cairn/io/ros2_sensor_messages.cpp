#include "cairn/io/ros2_sensor_messages.hpp"

#include "cairn/io/cdr.hpp"
#include "cairn/io/ros2_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>

namespace cairn::ros2 {
namespace {

static_assert(std::endian::native == std::endian::little, "images are written as they lie in memory");

template <class Pixel>
std::string encode_pixels(const ros::Header& header, int width, int height, std::string_view encoding,
                          std::span<const Pixel> pixels) {
  cdr::Writer fields;
  put_header(fields, header);
  fields.number(static_cast<std::uint32_t>(height)).number(static_cast<std::uint32_t>(width)).text(encoding);
  fields.number(std::uint8_t{0});  // little endian
  fields.number(static_cast<std::uint32_t>(static_cast<std::size_t>(width) * sizeof(Pixel)));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(pixels.data());
  fields.numbers(std::span<const std::uint8_t>(bytes, pixels.size_bytes()));
  return std::move(fields).bytes();
}

template <std::size_t Count>
void put_all(cdr::Writer& fields, const std::array<double, Count>& values) {
  for (const double value : values) fields.number(value);
}

}  // namespace

std::string encode_range(const ros::Header& header, const SonarScan& scan, std::size_t transducer) {
  const float range_m = scan.ranges_m[transducer];
  const float echo = scan.is_valid_range(range_m) ? range_m : std::numeric_limits<float>::infinity();
  cdr::Writer fields;
  put_header(fields, header);
  fields.number(std::uint8_t{0}).number(static_cast<float>(scan.cone_rad));  // ULTRASOUND
  fields.number(static_cast<float>(scan.range_min_m)).number(static_cast<float>(scan.range_max_m));
  return std::move(fields.number(echo)).bytes();
}

std::string encode_image(const ros::Header& header, const DepthImage& image) {
  if (const auto* millimetres = std::get_if<DepthImage::Millimetres>(&image.depths))
    return encode_pixels(header, image.width, image.height, "16UC1",
                         std::span<const std::uint16_t>(*millimetres));
  const auto& metres = std::get<DepthImage::Metres>(image.depths);
  return encode_pixels(header, image.width, image.height, "32FC1", std::span<const float>(metres));
}

std::string encode_camera_info(const ros::Header& header, const DepthImage& image) {
  const PinholeIntrinsics& k = image.intrinsics;
  cdr::Writer fields;
  put_header(fields, header);
  fields.number(static_cast<std::uint32_t>(image.height)).number(static_cast<std::uint32_t>(image.width));
  fields.text("plumb_bob").numbers(std::span<const double>(std::array<double, 5>{}));
  put_all<9>(fields, {k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0});
  put_all<9>(fields, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  put_all<12>(fields, {k.fx_px, 0.0, k.cx_px, 0.0, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 0.0, 1.0, 0.0});
  for (int i = 0; i < 6; ++i) fields.number(std::uint32_t{0});  // binning, region of interest: all of it
  fields.number(std::uint8_t{0});
  return std::move(fields).bytes();
}

std::string encode_image(const ros::Header& header, const CeilingPatch& patch) {
  return encode_pixels(header, patch.width, patch.height, "mono8", std::span<const std::uint8_t>(patch.gray));
}

std::string encode_imu(const ros::Header& header, const ImuYawRate& rate) {
  constexpr std::array<double, 9> kUnknown{-1.0};
  cdr::Writer fields;
  put_header(fields, header);
  put_all<4>(fields, {0.0, 0.0, 0.0, 1.0});
  put_all(fields, kUnknown);
  put_all<3>(fields, {0.0, 0.0, rate.yaw_rate_radps});
  put_all<9>(fields, {});
  put_all<3>(fields, {});
  put_all(fields, kUnknown);
  return std::move(fields).bytes();
}

}  // namespace cairn::ros2
