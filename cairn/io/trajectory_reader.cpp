#include "cairn/io/trajectory_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_log.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/plain_trajectory.hpp"
#include "cairn/io/pose_collector.hpp"
#include "cairn/io/tum_trajectory.hpp"
#include "cairn/io/wean_log.hpp"

namespace cairn {
namespace {

enum class Format { kCarmen, kWean, kTum, kPlain, kCsv };

Format format_of(std::istream& input, const std::string& name) {
  LineReader lines(input, name);
  if (!next_data_line(lines)) throw InputError(name, "holds no pose", "check that it is the right file");
  FieldReader fields(lines);
  const std::size_t count = fields.fields_left();
  const std::string_view first = fields.word("stamp");
  if (is_carmen_message(first)) return Format::kCarmen;
  if (first == "O" || first == "L") return Format::kWean;
  if (lines.line().find(',') != std::string_view::npos) return Format::kCsv;
  if (count == 8) return Format::kTum;
  if (count == 4) return Format::kPlain;
  throw InputError(lines.where(),
                   "a line of " + std::to_string(count) + " fields is no known trajectory format",
                   "use TUM (t x y z qx qy qz qw) or t x y theta");
}

void rewind(std::istream& input) {
  input.clear();
  input.seekg(0);
}

Trajectory read_plain_or_indexed(std::istream& input, const std::string& name,
                                 const TrajectoryOptions& options, Diagnostics& diagnostics) {
  const bool indexed = is_indexed_trajectory(input);
  rewind(input);
  if (!indexed) return read_plain_trajectory(input, name, diagnostics);
  if (options.frame_stamps.empty()) {
    throw InputError(name, "its poses are numbered 0, 1, 2, ..., not stamped",
                     "name the log they belong to, or write seconds with decimals (0.0)");
  }
  return read_indexed_trajectory(input, name, options.frame_stamps, options.frame_offset, diagnostics);
}

}  // namespace

Trajectory read_trajectory(std::istream& input, const std::string& name, const TrajectoryOptions& options,
                           Diagnostics& diagnostics) {
  const Format format = format_of(input, name);
  rewind(input);
  switch (format) {
    case Format::kCarmen:
      return read_carmen_trajectory(input, name, options.carmen_pose, diagnostics);
    case Format::kWean:
      return read_wean_trajectory(input, name);
    case Format::kTum:
      return read_tum(input, name, diagnostics);
    case Format::kCsv:
      return read_rawseeds_trajectory(input, name, diagnostics);
    case Format::kPlain:
      break;
  }
  return read_plain_or_indexed(input, name, options, diagnostics);
}

Trajectory read_trajectory(const std::filesystem::path& path, const TrajectoryOptions& options,
                           Diagnostics& diagnostics) {
  return read_trajectory(*open_input(path), path.string(), options, diagnostics);
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  return read_trajectory(path, {}, diagnostics);
}

}  // namespace cairn
