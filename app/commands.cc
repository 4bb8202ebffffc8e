// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands.h"

#include "app/cli/commands.h"
#include "app/inspect/bench.h"
#include "app/inspect/inspection.h"

namespace scoria::app {

void AddCommands(CLI::App& app, int& exit_code) {
  AddRun(app, exit_code);
  AddCampaign(app, exit_code);
  AddCheck(app, exit_code);
  AddGate(app, exit_code);
  AddReport(app);
  AddBench(app);
  AddCheckQps(app, exit_code);
  AddInspection(app);
  AddSchema(app);
  AddRender(app);
  AddVerify(app, exit_code);
  AddReplay(app, exit_code);
  AddScenarioFrom(app);
  AddCompare(app, exit_code);
  AddAnalyze(app);
  AddExport(app, exit_code);
}

}  // namespace scoria::app
