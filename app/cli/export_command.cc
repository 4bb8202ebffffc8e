// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/export/export_csv.h"
#include "app/export/export_mcap.h"
#include "app/export/export_signals.h"

namespace scoria::app {
namespace {

struct ExportArguments {
  ExportOptions what;
  std::vector<std::string> topics;
  std::string format;
  bool signals = false;
};

ExportResult Export(const ExportArguments& o) {
  if (o.signals) return ExportSignals(o.what);
  const bool is_mcap = o.format.empty() ? o.what.out.extension() == ".mcap" : o.format == "mcap";
  return is_mcap ? ExportMcap(o.what) : ExportCsv(o.what);
}

}  // namespace

void AddExport(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "write a log as CSV files, as MCAP, or as canonical signals");
  command->add_option("log", o->what.log, "a log: a file, or the folder of a bag")->required();
  command
      ->add_option("-o,--out", o->what.out,
                   "folder for a CSV file per topic; or the file that is written")
      ->required();
  CLI::Option* format =
      command->add_option("--format", o->format, "csv or mcap (default: by the name of the output)")
          ->check(CLI::IsMember({"csv", "mcap"}));
  CLI::Option* topics =
      command->add_option("--topics", o->topics, "topics to write, as /a,/b (default: all)")
          ->delimiter(',');
  command->add_flag("--signals", o->signals, "one CSV file of canonical signals, a line per row")
      ->excludes(topics)
      ->excludes(format);
  command
      ->add_option(
          "--mapping", o->what.mapping,
          "of signals: mapping file, or name of a shipped one (default: the one that fits)")
      ->needs("--signals");
  command->add_option("--from", o->what.from_s, "start, after the log's first message [s]");
  command->add_option("--to", o->what.to_s, "end, after the log's first message [s]");
  command->add_option("--msg-path", o->what.msg_paths,
                      "folder of .msg or .idl files that define types; may be repeated");
  command->add_flag("--force", o->what.force, "overwrite files that are there");
  command->callback([o, &exit_code] {
    if (!o->topics.empty()) o->what.topics = o->topics;
    o->what.interrupted = &Interrupted();
    const ExportResult result = Export(*o);
    for (const std::string& remark : result.remarks) Note(remark);
    for (const ExportedFile& file : result.files)
      fmt::print("{}: {} {}\n", file.path.string(), file.entries,
                 o->signals || file.path.extension() == ".csv" ? "rows" : "messages");
    if (!result.was_interrupted) return;
    Note("interrupted; nothing is written");
    exit_code = kStopped;
  });
}

}  // namespace scoria::app
