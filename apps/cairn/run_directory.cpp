#include "apps/cairn/run_directory.hpp"

#include "apps/cairn/run_tables.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/map_yaml.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include <unistd.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStage = ".writing";
constexpr const char* kMarker = "metrics.json";
// Files that a run may lack: those of an earlier run must not stay beside a new one.
constexpr const char* kOptional[] = {"particles.csv", "hypotheses.csv", "reference.tum", "map.yaml",
                                     "map.png",       "report.html",    "run.mcap"};
constexpr const char* kRecording = "run.mcap";
constexpr const char* kRunAgain = "write the run again with `cairn localize --out`";

nlohmann::json read_metrics(const fs::path& path) {
  const std::string text = read_file(path);
  auto metrics = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!metrics.is_object() || !metrics.contains("cairn_version")) {
    throw InputError(path.string(), "is not the metrics of a run of Cairn", kRunAgain);
  }
  return metrics;
}

bool holds_run(const fs::path& directory) {
  if (fs::is_directory(directory / kStage)) return true;  // a run whose writing was cut short
  if (!fs::is_regular_file(directory / kMarker)) return false;
  try {
    read_metrics(directory / kMarker);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void write_stage(const fs::path& stage, const RunData& run) {
  write_file(stage / "trajectory.tum", to_tum(run.trajectory));
  write_file(stage / "estimate.csv", to_csv(run.estimates));
  write_file(stage / "config.yaml", run.configuration);
  if (!run.hypotheses.empty()) write_file(stage / "hypotheses.csv", to_csv(run.hypotheses));
  if (!run.particles.empty()) write_file(stage / "particles.csv", to_csv(run.particles));
  if (run.map) write_map(stage / "map.yaml", *run.map);
  if (run.reference) write_file(stage / "reference.tum", to_tum(*run.reference));
  // Names in a log need not be UTF-8: what is not becomes the replacement character.
  write_file(stage / kMarker,
             run.metrics.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void publish(const fs::path& stage, const fs::path& directory) {
  fs::remove(directory / kMarker);
  for (const char* name : kOptional) fs::remove(directory / name);
  for (const auto& entry : fs::directory_iterator(stage)) {
    if (entry.path().filename() != kMarker) fs::rename(entry.path(), directory / entry.path().filename());
  }
  fs::rename(stage / kMarker, directory / kMarker);
  fs::remove_all(stage);
}

// Does the work; what the disk refuses becomes an InputError.
template <class Work>
auto or_refuse(const fs::path& directory, const Work& work) {
  try {
    return work();
  } catch (const fs::filesystem_error& error) {
    throw InputError(directory.string(), error.code().message(), "choose another --out or make room there");
  }
}

// The nearest folder above that exists is where a new one must be made.
void check_parent(const fs::path& directory) {
  fs::path parent = fs::absolute(directory);
  while (!fs::exists(fs::status(parent)) && parent.has_relative_path()) parent = parent.parent_path();
  if (!fs::is_directory(parent)) {
    if (parent == fs::absolute(directory)) return;  // said better by the caller
    throw ConfigurationError(directory.string(), parent.string() + " is a file, not a folder",
                             "choose another --out");
  }
  if (access(parent.c_str(), W_OK | X_OK) != 0) {
    throw ConfigurationError(directory.string(), "may not be written to", "choose another --out");
  }
}

}  // namespace

void check_run_directory(const fs::path& directory) {
  if (directory.empty()) throw ConfigurationError("--out", "is empty", "name a folder");
  check_parent(directory);
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) {
    throw ConfigurationError(directory.string(), "is a file, not a folder", "choose another --out");
  }
  if (!fs::is_empty(directory) && !holds_run(directory)) {
    throw ConfigurationError(directory.string(), "holds files that are not a run of Cairn",
                             "choose an empty or new folder for --out");
  }
}

fs::path prepare_recording(const fs::path& directory) {
  check_run_directory(directory);
  return or_refuse(directory, [&] {
    const fs::path stage = directory / kStage;
    fs::remove_all(stage);
    fs::create_directories(stage);
    return stage / kRecording;
  });
}

fs::path find_recording(const fs::path& directory) {
  for (const fs::path& path : {directory / kRecording, directory / kStage / kRecording}) {
    if (fs::is_regular_file(path)) return path;
  }
  throw InputError(directory.string(), "holds no recording (run.mcap)",
                   "name the --out folder of a `cairn localize` run that was recorded, or the file");
}

void write_run(const fs::path& directory, const RunData& run) {
  CAIRN_ASSERT(run.metrics.is_object() && run.metrics.contains("cairn_version"));
  check_run_directory(directory);
  or_refuse(directory, [&] {
    const fs::path stage = directory / kStage;
    CAIRN_ASSERT(!run.recorded || fs::is_regular_file(stage / kRecording));
    if (!run.recorded) fs::remove_all(stage);
    fs::create_directories(stage);
    write_stage(stage, run);
    publish(stage, directory);
  });
}

RunData read_run(const fs::path& directory) {
  if (!fs::is_directory(directory)) {
    throw InputError(directory.string(), "is not a folder",
                     "name the --out folder of a `cairn localize` run");
  }
  const auto text = [&](const char* name) { return read_file(directory / name); };
  const auto label = [&](const char* name) { return (directory / name).string(); };
  RunData run;
  run.metrics = read_metrics(directory / kMarker);
  run.trajectory = parse_tum(text("trajectory.tum"), label("trajectory.tum"));
  run.estimates = parse_estimates(text("estimate.csv"), label("estimate.csv"));
  run.configuration = text("config.yaml");
  if (fs::exists(directory / "map.yaml")) run.map = read_map(directory / "map.yaml");
  if (fs::exists(directory / "hypotheses.csv")) {
    run.hypotheses = parse_hypotheses(text("hypotheses.csv"), label("hypotheses.csv"));
  }
  if (fs::exists(directory / "particles.csv")) {
    run.particles = parse_particles(text("particles.csv"), label("particles.csv"));
  }
  if (fs::exists(directory / "reference.tum")) {
    run.reference = parse_tum(text("reference.tum"), label("reference.tum"));
  }
  return run;
}

std::string read_file(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError(path.string(), "is missing", kRunAgain);
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InputError(path.string(), "cannot be read", "look at its permissions");
  return content;
}

void write_file(const fs::path& path, std::string_view content) {
  fs::path temporary = path;
  temporary += ".tmp";
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  std::error_code error;
  if (file) fs::rename(temporary, path, error);
  if (!file || error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError(path.string(), "cannot be written", "look at the permissions and the free space there");
  }
}

}  // namespace cairn::app
