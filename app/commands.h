// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace scoria::app {

/// Adds every subcommand of `scoria`. The one that the user names sets `exit_code`.
void AddCommands(CLI::App& app, int& exit_code);

}  // namespace scoria::app
