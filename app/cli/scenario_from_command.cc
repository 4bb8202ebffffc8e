// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/rerun/draft_scenario.h"
#include "core/files.h"

namespace scoria::app {

void AddScenarioFrom(CLI::App& app) {
  struct Options {
    DraftScenarioOptions draft;
    bool force = false, no_walks = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("scenario-from", "draft the scenario that repeats a log of any origin");
  command->add_option("log", o->draft.input.log, "a log: a file, or the folder of a bag")
      ->required();
  command->add_option("-o,--out", o->draft.out, "the scenario's YAML")->required();
  command->add_option("--robot", o->draft.input.robot, "the robot's YAML (default: the log's own)");
  command->add_option("--mapping", o->draft.input.rows.mapping,
                      "mapping file, or name of a shipped one (default: the one that fits)");
  command->add_option("--msg-path", o->draft.input.rows.msg_paths,
                      "folder of .msg or .idl files that define types; may be repeated");
  command->add_option("--terrains", o->draft.terrains, "folder of terrain presets")
      ->capture_default_str()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--controllers", o->draft.controllers,
                   "folder of controllers, one of the robot's name is taken as base")
      ->capture_default_str();
  command->add_flag("--no-walks", o->no_walks,
                    "do not walk the draft to read the ground's friction, which takes a minute");
  command->add_flag("--force", o->force, "overwrite a file that is there");
  command->callback([o] {
    o->draft.walks = !o->no_walks;
    const std::filesystem::path& out = o->draft.out;
    if (std::filesystem::exists(out) && !o->force)
      throw std::runtime_error(
          fmt::format("{}: is there already; --force overwrites it", out.string()));
    if (out.has_parent_path()) core::CreateFolders(out.parent_path());
    core::WriteText(out, DraftScenario(o->draft));
    fmt::print("{}\n", out.string());
  });
}

}  // namespace scoria::app
