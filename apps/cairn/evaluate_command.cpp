#include "apps/cairn/campaign_run.hpp"
#include "apps/cairn/commands.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/eval/campaign_figures.hpp"
#include "cairn/eval/campaign_tables.hpp"
#include "web/report_page.hpp"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <set>
#include <thread>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

constexpr int kMostJobs = 1024;
constexpr std::size_t kShownFailures = 3;

struct Arguments {
  std::string campaign;
  std::string out;
  std::string cells;
  std::vector<std::string> merge;
  int jobs = 0;
  bool merging = false;
};

int default_jobs() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

std::size_t parse_index(const std::string& text, const std::string& part, std::size_t count) {
  std::size_t index = 0;
  const char* const end = part.data() + part.size();
  const auto result = std::from_chars(part.data(), end, index);
  if (result.ec == std::errc() && result.ptr == end && index < count) return index;
  throw ConfigurationError("--cells", "'" + text + "' names no cells of this campaign",
                           fmt::format("give first..last within 0..{}", count - 1));
}

CampaignRunOptions share_of(const Arguments& arguments, std::size_t count) {
  CampaignRunOptions options{arguments.jobs > 0 ? arguments.jobs : default_jobs(), 0, count - 1};
  if (arguments.cells.empty()) return options;
  const std::size_t dots = arguments.cells.find("..");
  options.first = parse_index(arguments.cells, arguments.cells.substr(0, dots), count);
  options.last = dots == std::string::npos
                     ? options.first
                     : parse_index(arguments.cells, arguments.cells.substr(dots + 2), count);
  if (options.last < options.first)
    throw ConfigurationError("--cells", "counts downwards", "give first..last");
  return options;
}

void tell_failures(const std::vector<CampaignFailure>& failures, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < std::min(failures.size(), kShownFailures); ++i) {
    spdlog::error("{} (by {})", failures[i].reason, failures[i].command);
  }
  if (!failures.empty()) {
    spdlog::error("{} commands failed; what they said is in {}; the next call runs them again",
                  failures.size(), (folder / "failed").string());
  }
}

void warn_of_mixed_programs(const std::vector<CellResult>& results, const std::filesystem::path& folder) {
  std::set<std::string> programs;
  for (const CellResult& result : results) programs.insert(result.program);
  if (programs.size() < 2) return;
  spdlog::warn("the cells were run by {} different builds of the program; remove {} to run all by one",
               programs.size(), (folder / "cells").string());
}

void write_results(const std::filesystem::path& folder, const CampaignReport& report) {
  write_file(folder / "results.csv", to_csv(report));
  write_file(folder / "results.json", to_json(report));
  write_file(folder / "tables.md", to_markdown(report));
  std::filesystem::create_directories(folder / "figures");
  for (const CampaignFigure& figure : campaign_figures(report))
    write_file(folder / "figures" / (figure.name + ".svg"), figure.svg);
  const std::string page = web::campaign_page();
  if (page.empty()) {
    spdlog::warn("no index.html: {}", web::why_no_report_page());
  } else {
    write_file(folder / "index.html", render_campaign(page, report));
  }
}

int show_results(const CampaignFile& file, const CampaignFolder& folder) {
  std::vector<CellResult> results = gather_results(file, folder);
  warn_of_mixed_programs(results, folder.path());
  const std::size_t finished = results.size();
  const CampaignReport report = make_campaign_report(file.campaign, std::move(results));
  write_results(folder.path(), report);
  std::cout << to_markdown(report) << "\nwritten to " << folder.path().string() << "\n";
  if (finished == file.cells.size()) return kOk;
  spdlog::warn("{} of {} cells are not finished", file.cells.size() - finished, file.cells.size());
  return kFailed;
}

int run_evaluate(const Arguments& arguments) {
  const CampaignFile file = read_campaign(arguments.campaign);
  const CampaignRunOptions share = share_of(arguments, file.cells.size());
  const CampaignFolder folder(arguments.out);
  if (arguments.merging) {
    for (const std::string& other : arguments.merge) {
      if (!other.empty()) folder.take_cells_of(other);  // CLI11 gives an empty one for `--merge` alone
    }
    return show_results(file, folder);
  }
  const CampaignOutcome outcome = run_campaign(file, folder, share);
  spdlog::info("{} cells run, {} were finished before", outcome.ran, outcome.skipped);
  tell_failures(outcome.failures, folder.path());
  if (outcome.interrupted) {
    spdlog::warn("interrupted: the same command goes on with the cells that are missing");
    return kFailed;
  }
  if (!arguments.cells.empty()) return outcome.failures.empty() ? kOk : kFailed;
  return show_results(file, folder);
}

}  // namespace

void add_evaluate(CLI::App& program, Runner& run) {
  auto* command =
      program.add_subcommand("evaluate", "Run an experiment: many recordings, recipes, parameters, seeds");
  auto a = std::make_shared<Arguments>();
  command->add_option("CAMPAIGN", a->campaign, "What to run (YAML; see docs/campaigns.md)")->required();
  command->add_option("--out", a->out, "Folder for the results; finished cells found there are not run again")
      ->required();
  command->add_option("--jobs", a->jobs, "Cells at a time (default: as many as there are cores)")
      ->check(CLI::Range(1, kMostJobs));
  auto* cells = command->add_option("--cells", a->cells, "i..j: run only these cells, and make no tables");
  command
      ->add_option("--merge", a->merge, "Run nothing: gather the finished cells, also those of these folders")
      ->expected(0, CLI::detail::expected_max_vector_size)
      ->excludes(cells);
  command->footer(
      "Exit code: 0 all cells are finished, 1 some failed or were not run, 2 usage or campaign, 3 input that "
      "cannot be read. A run that ends lost is a result, not a failure.");
  command->callback([a, command, &run] {
    a->merging = command->count("--merge") > 0;
    run = [a] { return run_evaluate(*a); };
  });
}

}  // namespace cairn::app
