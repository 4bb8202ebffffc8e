// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace scoria::app {

enum ExitCode { kOk = 0, kFailed = 1, kBadInput = 2, kStopped = 3 };

/// Adds every subcommand of `scoria`. The one that the user names sets `exit_code`.
void AddCommands(CLI::App& app, int& exit_code);

}  // namespace scoria::app
