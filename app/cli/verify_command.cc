// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/rerun/verify.h"

namespace scoria::app {

void AddVerify(CLI::App& app, int& exit_code) {
  auto log = std::make_shared<std::string>();
  CLI::App* verify = app.add_subcommand("verify", "re-run a log and compare it bit for bit");
  verify->add_option("log", *log, "MCAP log that scoria wrote")->required();
  verify->callback([log, &exit_code] {
    const VerifyResult result = VerifyLog(*log);
    if (!result.file_problem.empty()) fmt::print("{}\n", result.file_problem);
    if (!result.missing.empty())
      fmt::print("{}; state hashes and rows are not compared\n", result.missing);
    if (result.identical) {
      fmt::print("identical: {} messages{}\n", result.messages,
                 result.complete ? "" : fmt::format(", up to {:.3f} s", result.until_s));
    } else {
      fmt::print("first difference after {} equal messages: {}\n",
                 result.messages > 0 ? result.messages - 1 : 0, result.difference);
    }
    exit_code = result.identical ? kOk : kFailed;
  });
}

}  // namespace scoria::app
