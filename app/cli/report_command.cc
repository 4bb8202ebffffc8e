// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "analysis/report/report.h"
#include "app/campaign/report_picture.h"
#include "app/cli/commands.h"

namespace scoria::app {

void AddReport(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* report =
      app.add_subcommand("report", "write FOLDER/report/report.html of a run or campaign");
  report->add_option("folder", *folder, "what run or campaign wrote")->required();
  report->callback([folder] {
    fmt::print("{}\n", analysis::WriteReport(*folder, MakeReportPicture(*folder)).string());
  });
}

}  // namespace scoria::app
