// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "controller/qp/sets/qp_check.h"

namespace scoria::app {

void AddCheckQps(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* check =
      app.add_subcommand("check-qps", "check the optimality conditions of saved QPs, one by one");
  check->add_option("folder", *folder, "what run --save-qps wrote")->required();
  check->callback([folder, &exit_code] {
    for (const controller::QpCheck& c : controller::CheckQpFiles(*folder)) {
      fmt::print(
          "{:16} {} problems: primal {:.1e}, dual {:.1e}, stationarity {:.1e}, complementarity "
          "{:.1e}: {}\n",
          c.file, c.records, c.primal, c.dual, c.stationarity, c.complementarity,
          c.Holds() ? "optimal" : "NOT optimal");
      if (!c.Holds()) exit_code = kFailed;
    }
  });
}

}  // namespace scoria::app
