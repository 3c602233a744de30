#include "apps/cairn/report_command.hpp"

#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"
#include "web/report_page.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReportCommand : public testing::Test {
 protected:
  ReportCommand() {
    std::string name = (fs::temp_directory_path() / "cairn_report_XXXXXX").string();
    directory_ = mkdtemp(name.data());
    RunData run;
    run.metrics = {{"cairn_version", "0.1.0"}, {"recipe", "a recipe of its own"}};
    run.map = std::make_shared<OccupancyGrid>(GridGeometry{2, 1, 0.1, {}},
                                              std::vector<OccupancyGrid::Cell>{0, 100});
    write_run(directory_, run);
  }
  ~ReportCommand() override { fs::remove_all(directory_); }

  fs::path directory_;
};

TEST_F(ReportCommand, WritesThePageOrSaysWhyNot) {
  const std::string missing = write_report(directory_);
  EXPECT_EQ(missing, web::why_no_report_page());
  EXPECT_EQ(missing.empty(), !web::report_page().empty());
  EXPECT_EQ(fs::exists(directory_ / "report.html"), missing.empty());
  if (!missing.empty()) GTEST_SKIP() << missing;
  const std::string page = read_file(directory_ / "report.html");
  EXPECT_THAT(page, HasSubstr("a recipe of its own"));
  EXPECT_THAT(page, HasSubstr("\"png\":\"iVBORw0KGgo"));  // the signature of PNG
  EXPECT_THAT(page, HasSubstr("Apache ECharts"));         // its licence asks for the notice
}

TEST_F(ReportCommand, RefusesAFolderThatHoldsNoRun) {
  EXPECT_THROW(write_report(directory_ / "nowhere"), InputError);
  fs::remove(directory_ / "map.png");
  EXPECT_THROW(write_report(directory_), InputError);
}

}  // namespace
}  // namespace cairn::app
