#include "apps/cairn/process_pool.hpp"

#include "cairn/core/errors.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cairn::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPause = std::chrono::milliseconds(5);
constexpr int kCannotStart = 127;
constexpr int kSignalled = 128;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// In the child, between fork and exec: nothing that allocates.
[[noreturn]] void become(char* const* arguments, const char* output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);  // Ctrl-C is for the parent, which then kills the jobs
  const int file = open(output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool ready = getppid() == parent && file >= 0 && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 &&
                     dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0;
  if (ready) execv(arguments[0], arguments);
  _exit(kCannotStart);
}

pid_t start(const Job& job) {
  std::vector<std::string> words = job.command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string output = job.output.string();
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become(arguments.data(), output.c_str(), parent);
  if (child < 0) {
    throw InputError(job.command.front(), std::string("cannot be started: ") + std::strerror(errno),
                     "free memory or processes, or use fewer --jobs");
  }
  return child;
}

class Pool {
 public:
  explicit Pool(double timeout_s) : timeout_s_(timeout_s) {}
  ~Pool() { kill_all(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  std::size_t size() const { return running_.size(); }
  void add(std::size_t index, const Job& job) {
    running_[::cairn::app::start(job)] = {index, Clock::now(), false};
  }

  // Calls `done` for each job that has ended.
  void collect(const std::function<void(const JobEnd&)>& done) {
    int status = 0;
    rusage usage{};
    for (pid_t pid = 0; (pid = wait4(-1, &status, WNOHANG, &usage)) > 0;) {
      const auto found = running_.find(pid);
      if (found == running_.end()) continue;
      const Running job = found->second;
      running_.erase(found);
      done(end_of(job, status, usage));
    }
  }

  void kill_overdue() {
    for (auto& [pid, job] : running_) {
      if (job.timed_out || seconds_since(job.started) < timeout_s_) continue;
      job.timed_out = true;
      kill(pid, SIGKILL);
    }
  }

 private:
  struct Running {
    std::size_t index = 0;
    Clock::time_point started;
    bool timed_out = false;
  };

  static JobEnd end_of(const Running& job, int status, const rusage& usage) {
    return {.job = job.index,
            .exit_code = WIFSIGNALED(status) ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status),
            .timed_out = job.timed_out,
            .wall_s = seconds_since(job.started),
            .cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime),
            .peak_memory_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024};
  }

  void kill_all() {
    for (const auto& [pid, unused] : running_) kill(pid, SIGKILL);
    for (const auto& [pid, unused] : running_) waitpid(pid, nullptr, 0);
    running_.clear();
  }

  double timeout_s_;
  std::map<pid_t, Running> running_;
};

}  // namespace

bool run_jobs(const std::vector<Job>& jobs, const PoolOptions& options,
              const std::function<void(const JobEnd&)>& done, const std::function<bool()>& go_on) {
  Pool pool(options.timeout_s);
  const auto slots = static_cast<std::size_t>(options.slots);
  std::size_t next = 0;
  while (next < jobs.size() || pool.size() > 0) {
    if (!go_on()) return false;
    while (next < jobs.size() && pool.size() < slots) {
      pool.add(next, jobs[next]);
      ++next;
    }
    pool.collect(done);
    pool.kill_overdue();
    if (pool.size() >= slots || next == jobs.size()) std::this_thread::sleep_for(kPause);
  }
  return true;
}

std::string shell_line(const std::vector<std::string>& command) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string line;
  for (const std::string& word : command) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

std::filesystem::path own_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace cairn::app
