#include "cairn/io/beam_text.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/pose_collector.hpp"
#include "cairn/io/text_fields.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kLongest_m = 1e4;
constexpr double kLargestBearing = 100.0;  // beyond, the bearings are degrees

Point2 end_point(FieldReader& fields, double bearing, double range) {
  if (std::abs(bearing) > kLargestBearing) fields.fail("bearing beyond 100 rad", "give bearings in radians");
  if (range > kLongest_m) fields.fail("range beyond 10 km", "give ranges in metres");
  return {range * std::cos(bearing), range * std::sin(bearing)};
}

}  // namespace

std::vector<Point2> read_beams(std::istream& input, const std::string& name) {
  LineReader lines(input, name);
  std::vector<Point2> points;
  while (next_data_line(lines)) {
    FieldReader fields(lines, " \t,");
    const double bearing = fields.number("bearing");
    const double range = fields.maybe_not_finite("range");
    const bool returned = std::isfinite(range) && range > 0.0;
    if (returned) points.push_back(end_point(fields, bearing, range));
    expect_line_end(fields);
  }
  if (points.empty())
    throw InputError(name, "holds no beam with a return", "give lines of bearing and range");
  return points;
}

}  // namespace cairn
