#include "apps/cairn/process_pool.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

namespace cairn::app {
namespace {

class ProcessPool : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Job shell(const std::string& script) {
    return {{"/bin/sh", "-c", script}, folder_ / ("out" + std::to_string(count_++))};
  }
  std::string output(const Job& job) const {
    std::ifstream file(job.output);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static std::vector<JobEnd> run(const std::vector<Job>& jobs, const PoolOptions& options = {}) {
    std::vector<JobEnd> ends(jobs.size());
    EXPECT_TRUE(run_jobs(
        jobs, options, [&](const JobEnd& end) { ends[end.job] = end; }, [] { return true; }));
    return ends;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("cairn_process_pool_" + std::to_string(getpid()));
  int count_ = 0;
};

TEST_F(ProcessPool, TellsHowEachJobEnded) {
  const std::vector jobs{shell("echo out; echo err >&2"), shell("exit 4"), shell("kill -9 $$"),
                         Job{{"/no/such/program"}, folder_ / "none"}};
  const std::vector<JobEnd> ends = run(jobs, {.slots = 2});
  EXPECT_EQ(ends[0].exit_code, 0);
  EXPECT_EQ(output(jobs[0]), "out\nerr\n");
  EXPECT_EQ(ends[1].exit_code, 4);
  EXPECT_EQ(ends[2].exit_code, 128 + 9);
  EXPECT_EQ(ends[3].exit_code, 127);
  EXPECT_GT(ends[0].peak_memory_bytes, 0);
}

TEST_F(ProcessPool, NeverRunsMoreThanItsSlots) {
  // Each job notes how many are running while it runs.
  const std::string dir = folder_.string();
  std::vector<Job> jobs;
  for (int i = 0; i < 8; ++i) {
    jobs.push_back(
        shell("touch " + dir + "/run$$; ls " + dir + " | grep -c run; sleep 0.01; rm " + dir + "/run$$"));
  }
  run(jobs, {.slots = 3});
  int most = 0;
  for (const Job& job : jobs) most = std::max(most, std::stoi(output(job)));
  EXPECT_LE(most, 3);
  EXPECT_GE(most, 1);
}

TEST_F(ProcessPool, KillsWhatTakesTooLong) {
  const std::vector<JobEnd> ends = run({shell("exec sleep 60")}, {.timeout_s = 0.05});
  EXPECT_TRUE(ends[0].timed_out);
  EXPECT_LT(ends[0].wall_s, 30.0);
}

TEST_F(ProcessPool, StopsWhenAskedTo) {
  int asked = 0;
  EXPECT_FALSE(run_jobs(
      {shell("exec sleep 60")}, {}, [](const JobEnd&) {}, [&] { return ++asked < 3; }));
}

TEST_F(ProcessPool, AnErrorInDoneKillsTheRest) {
  const auto fail = [](const JobEnd&) { throw std::runtime_error("disk full"); };
  EXPECT_THROW(run_jobs({shell("true"), shell("exec sleep 60")}, {.slots = 2}, fail, [] { return true; }),
               std::runtime_error);
}

TEST_F(ProcessPool, AShellRunsTheLineAgain) {
  EXPECT_EQ(shell_line({"cairn", "--set", "a=1", "it's", ""}), "cairn --set a=1 'it'\\''s' ''");
}

}  // namespace
}  // namespace cairn::app
