#include "apps/cairn/report_command.hpp"

#include "apps/cairn/commands.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/eval/report.hpp"
#include "web/report_page.hpp"

#include <memory>

#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

ReportData report_data(RunData&& run, std::string map_png) {
  ReportData data;
  data.metrics = run.metrics.dump();
  data.configuration = std::move(run.configuration);
  data.trajectory = std::move(run.trajectory);
  data.estimates = std::move(run.estimates);
  data.hypotheses = std::move(run.hypotheses);
  data.particles = std::move(run.particles);
  data.reference = std::move(run.reference);
  if (run.map) data.map = ReportMap{std::move(map_png), run.map->geometry()};
  return data;
}

int report(const std::filesystem::path& directory) {
  const std::string missing = write_report(directory);
  if (!missing.empty()) {
    spdlog::error("there is no report page in this program: {}", missing);
    return kFailed;
  }
  spdlog::info("wrote {}", (directory / "report.html").string());
  return kOk;
}

}  // namespace

std::string write_report(const std::filesystem::path& directory) {
  RunData run = read_run(directory);
  const std::string page = web::report_page();
  if (page.empty()) return web::why_no_report_page();
  std::string map_png = run.map ? read_file(directory / "map.png") : std::string();
  write_file(directory / "report.html", render_report(page, report_data(std::move(run), std::move(map_png))));
  return {};
}

void add_report(CLI::App& program, Runner& run) {
  CLI::App* command = program.add_subcommand("report", "Write the self-contained HTML report of a run");
  auto directory = std::make_shared<std::filesystem::path>();
  command->add_option("dir", *directory, "folder that `cairn localize --out` wrote")->required();
  command->callback([directory, &run] { run = [directory] { return report(*directory); }; });
}

}  // namespace cairn::app
