#include "apps/cairn/campaign_run.hpp"

#include "apps/cairn/fingerprint.hpp"
#include "apps/cairn/interrupt.hpp"
#include "apps/cairn/progress.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"

#include <fstream>
#include <map>
#include <set>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

std::string program_name() {
  Fingerprint fingerprint;
  fingerprint.add_whole_file(own_program().string());
  return std::string(CAIRN_VERSION) + " " + fingerprint.text();
}

std::string last_line(const fs::path& path) {
  std::ifstream file(path);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

std::string reason_of(const Job& job, const JobEnd& end) {
  if (end.timed_out) return fmt::format("took longer than {:.0f} s", end.wall_s);
  const std::string line = last_line(job.output);
  return line.empty() ? fmt::format("ended with exit code {}", end.exit_code) : line;
}

std::vector<std::string> command_of(const std::vector<std::string>& arguments, const fs::path& out) {
  std::vector<std::string> command{own_program().string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.insert(command.end(), {"--out", out.string()});
  return command;
}

struct Task {
  CampaignCell cell;
  CellRecording recording;
  std::string id;
};

class CampaignRunner {
 public:
  CampaignRunner(const CampaignFile& file, const CampaignFolder& folder, const CampaignRunOptions& options)
      : file_(file), folder_(folder), options_(options), program_(program_name()) {}

  CampaignOutcome run() {
    collect_tasks();
    simulate();
    if (!outcome_.interrupted) localize();
    return std::move(outcome_);
  }

 private:
  void collect_tasks() {
    for (std::size_t i = options_.first; i <= options_.last; ++i) {
      const CampaignCell& cell = file_.cells[i];
      CellRecording recording = recording_of(file_.campaign, cell, folder_.logs());
      std::string id = cell_id(file_.campaign, cell, recording);
      if (folder_.has_cell(id)) {
        ++outcome_.skipped;
      } else {
        tasks_.push_back({cell, std::move(recording), std::move(id)});
      }
    }
  }

  PoolOptions pool() const { return {options_.jobs, file_.campaign.timeout_s}; }

  // Runs the jobs under a progress bar; `done` is told of each.
  void run_pool(const char* label, const std::vector<Job>& jobs,
                const std::function<void(const JobEnd&)>& done) {
    Progress progress(label, static_cast<std::int64_t>(jobs.size()));
    std::int64_t ended = 0;
    const auto count = [&](const JobEnd& end) {
      if (!interrupt_.requested()) done(end);
      progress.update(++ended);
    };
    outcome_.interrupted = !run_jobs(jobs, pool(), count, [this] { return !interrupt_.requested(); });
  }

  void fail(const Job& job, const JobEnd& end, const std::string& id) {
    outcome_.failures.push_back({shell_line(job.command), reason_of(job, end)});
    if (fs::exists(job.output)) folder_.keep_failure(job.output, id);
  }

  void simulate() {
    std::map<std::string, const CellRecording*> wanted;
    for (const Task& task : tasks_) {
      const bool missing =
          !task.recording.simulate.empty() && !fs::is_directory(folder_.logs() / task.recording.id);
      if (missing) wanted[task.recording.id] = &task.recording;
    }
    std::vector<Job> jobs;
    std::vector<std::string> ids;
    for (const auto& [id, recording] : wanted) {
      const fs::path made = folder_.working() / id;
      fs::create_directories(made);
      jobs.push_back(
          {command_of(recording->simulate, made / recording->file), folder_.working() / (id + ".txt")});
      ids.push_back(id);
    }
    run_pool("simulating", jobs, [&](const JobEnd& end) {
      const std::string& id = ids[end.job];
      if (end.exit_code == 0) return folder_.keep_log(folder_.working() / id, id);
      fail(jobs[end.job], end, id);
      not_simulated_.insert(id);
    });
  }

  void localize() {
    std::vector<Job> jobs;
    std::vector<const Task*> of_job;
    for (const Task& task : tasks_) {
      if (not_simulated_.count(task.recording.id) != 0) continue;
      const auto arguments = cell_arguments(file_.campaign, task.cell, task.recording);
      jobs.push_back(
          {command_of(arguments, folder_.working() / task.id), folder_.working() / (task.id + ".txt")});
      of_job.push_back(&task);
    }
    run_pool("evaluating", jobs, [&](const JobEnd& end) { finish(*of_job[end.job], jobs[end.job], end); });
  }

  void finish(const Task& task, const Job& job, const JobEnd& end) {
    constexpr int kEndedLost = 4;
    if (end.timed_out || (end.exit_code != 0 && end.exit_code != kEndedLost)) return fail(job, end, task.id);
    const fs::path run = folder_.working() / task.id;
    CellResult result = read_cell(file_.campaign, task.cell, run, end);
    result.id = task.id;
    result.program = program_;
    std::vector<std::string> command{"cairn"};
    const auto arguments = cell_arguments(file_.campaign, task.cell, task.recording);
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"--out", "RUN"});
    result.command = shell_line(command);
    folder_.write_cell(result);
    fs::remove_all(run);
    fs::remove(job.output);
    ++outcome_.ran;
  }

  const CampaignFile& file_;
  const CampaignFolder& folder_;
  const CampaignRunOptions options_;
  const std::string program_;
  const InterruptGuard interrupt_;
  std::vector<Task> tasks_;
  std::set<std::string> not_simulated_;
  CampaignOutcome outcome_;
};

}  // namespace

CampaignOutcome run_campaign(const CampaignFile& file, const CampaignFolder& folder,
                             const CampaignRunOptions& options) {
  CAIRN_ASSERT(options.first <= options.last && options.last < file.cells.size());
  return CampaignRunner(file, folder, options).run();
}

std::vector<CellResult> gather_results(const CampaignFile& file, const CampaignFolder& folder) {
  std::vector<CellResult> results;
  for (const CampaignCell& cell : file.cells) {
    const CellRecording recording = recording_of(file.campaign, cell, folder.logs());
    if (auto result = folder.read_cell(cell_id(file.campaign, cell, recording))) {
      results.push_back(std::move(*result));
    }
  }
  return results;
}

}  // namespace cairn::app
