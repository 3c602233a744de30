#include "cairn/io/tum_trajectory.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/pose_collector.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

namespace cairn {
namespace {

constexpr double kMaxLengthError = 0.01;

double yaw_of_quaternion(FieldReader& fields) {
  const double x = fields.number("qx");
  const double y = fields.number("qy");
  const double z = fields.number("qz");
  const double w = fields.number("qw");
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(std::abs(length - 1.0) <= kMaxLengthError)) {
    fields.fail("the quaternion's length is " + std::to_string(length) + ", not 1", "order it qx qy qz qw");
  }
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

void put(std::ostream& output, double value, int decimals) {
  std::array<char, 400> text;  // the longest double in fixed notation has 309 digits before the point
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  output.write(text.data(), end.ptr - text.data());
}

}  // namespace

Trajectory read_tum(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  LineReader lines(input, name);
  PoseCollector poses;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    const Time stamp = read_stamp(fields);
    Pose2 pose{read_coordinate(fields, "x"), read_coordinate(fields, "y"), 0.0};
    read_coordinate(fields, "z");
    pose.theta = normalize_angle(yaw_of_quaternion(fields));
    expect_line_end(fields);
    poses.add(stamp, pose, lines, diagnostics);
  }
  return poses.finish(lines, diagnostics);
}

void write_tum(std::ostream& output, const Trajectory& trajectory) {
  for (const auto& [stamp, pose] : trajectory) {
    output << format_time(stamp) << ' ';
    put(output, pose.x, 9);
    output << ' ';
    put(output, pose.y, 9);
    output << " 0 0 0 ";
    put(output, std::sin(0.5 * pose.theta), 12);
    output << ' ';
    put(output, std::cos(0.5 * pose.theta), 12);
    output << '\n';
  }
}

void write_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::ofstream file(path, std::ios::binary);
  write_tum(file, trajectory);
  file.close();
  if (!file)
    throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
}

}  // namespace cairn
