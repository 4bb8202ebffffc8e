// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/exit_codes.h"

namespace scoria::app {

/// Each adds one subcommand of `scoria`, which sets `exit_code` if it ends in another way than
/// well.
void AddRun(CLI::App& app, int& exit_code);
void AddCampaign(CLI::App& app, int& exit_code);
void AddCheck(CLI::App& app, int& exit_code);
void AddGate(CLI::App& app, int& exit_code);
void AddReport(CLI::App& app);
void AddRender(CLI::App& app);
void AddCheckQps(CLI::App& app, int& exit_code);
void AddSchema(CLI::App& app);
void AddVerify(CLI::App& app, int& exit_code);
void AddReplay(CLI::App& app, int& exit_code);
void AddScenarioFrom(CLI::App& app);
void AddCompare(CLI::App& app, int& exit_code);
void AddAnalyze(CLI::App& app);
void AddExport(CLI::App& app, int& exit_code);

}  // namespace scoria::app
