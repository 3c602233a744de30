#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cairn::app {

/// A program to run: its path and its arguments, and the file that gets what it prints (both streams).
struct Job {
  std::vector<std::string> command;
  std::filesystem::path output;
};

struct JobEnd {
  std::size_t job = 0;  ///< index
  int exit_code = 0;    ///< 128 + signal where a signal ended it, 127 if it could not be started
  bool timed_out = false;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all its threads, user and system
  std::int64_t peak_memory_bytes = 0;
};

struct PoolOptions {
  int slots = 1;              ///< jobs at a time
  double timeout_s = 3600.0;  ///< a job that takes longer is killed
};

/// Runs all jobs, the first ones first, `slots` at a time, and calls `done` (in this thread) as each ends.
/// They die with this process, however it ends. As soon as `go_on` says no, or `done` throws, the running
/// ones are killed.
/// @return false if it was stopped
/// @throws InputError if no process can be started
bool run_jobs(const std::vector<Job>& jobs, const PoolOptions& options,
              const std::function<void(const JobEnd&)>& done, const std::function<bool()>& go_on);

/// The command as one line that a shell runs again.
std::string shell_line(const std::vector<std::string>& command);

/// Path of the running program.
std::filesystem::path own_program();

}  // namespace cairn::app
