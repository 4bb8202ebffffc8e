// SPDX-License-Identifier: BSD-3-Clause
#include <exception>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/commands.h"
#include "app/version.h"
#include "core/config/node.h"

int main(int argc, char** argv) {
  CLI::App app{
      "scoria: walks quadrupeds over rough ground in simulation and compares their controllers"};
  app.set_version_flag("--version", scoria::app::kVersion);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 a check failed or logs differ, 2 wrong input, 3 interrupted.");
  int exit_code = 0;
  scoria::app::AddCommands(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
  return exit_code;
}
