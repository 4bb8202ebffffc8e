// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/print_estimation.h"
#include "app/rerun/replay.h"

namespace scoria::app {

void AddReplay(CLI::App& app, int& exit_code) {
  struct Options {
    std::string log;
    std::vector<std::string> set;
  };
  auto o = std::make_shared<Options>();
  CLI::App* replay = app.add_subcommand(
      "replay", "estimate again from the inputs that a log holds, as they were or with --set");
  replay->add_option("log", o->log, "MCAP log that scoria wrote with log.keep=full")->required();
  replay->add_option("--set", o->set, "override a key, as controller.estimator.type=linear_kf");
  replay->callback([o, &exit_code] {
    const ReplayResult result = ReplayLog(o->log, o->set);
    if (!result.file_problem.empty()) fmt::print("{}\n", result.file_problem);
    fmt::print("replayed {} steps: {}\n", result.steps,
               result.identical
                   ? fmt::format("all {} estimates have the bits of the log", result.rows)
                   : fmt::format("estimates differ from {:.3f} s on", result.first_difference_s));
    PrintEstimation("logged", result.logged, result.groups);
    PrintEstimation("replayed", result.replayed, result.groups);
    if (!result.identical && o->set.empty()) exit_code = kFailed;
  });
}

}  // namespace scoria::app
