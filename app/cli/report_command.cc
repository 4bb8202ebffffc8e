// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "analysis/report/report.h"
#include "app/campaign/report_picture.h"
#include "app/cli/commands.h"
#include "app/cli/test_goal_options.h"

namespace scoria::app {

void AddReport(CLI::App& app) {
  struct Options {
    std::string folder;
    analysis::TestGoal goal;
  };
  auto o = std::make_shared<Options>();
  CLI::App* report =
      app.add_subcommand("report", "write FOLDER/report/report.html of a run or campaign");
  report->add_option("folder", o->folder, "what run or campaign wrote")->required();
  AddTestGoal(*report, o->goal);
  report->callback([o] {
    fmt::print("{}\n", analysis::WriteReport(o->folder, MakeReportPicture(o->folder),
                                             analysis::AllMetrics(), o->goal)
                           .string());
  });
}

}  // namespace scoria::app
