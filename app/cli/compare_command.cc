// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/html.h"
#include "analysis/report/json_text.h"
#include "analysis/report/plain_text.h"
#include "app/cli/commands.h"
#include "app/compare/compare_page.h"
#include "core/files.h"

namespace scoria::app {
namespace {

struct CompareArguments {
  std::string a, b;
  AnalyzeOptions how;
  double alpha = 0.05;
  std::filesystem::path out;
  bool fail = false;
};

/// For a terminal.
analysis::Document WithoutFigures(analysis::Document page) {
  for (analysis::Chapter& chapter : page.chapters)
    std::erase_if(chapter.blocks, [](const analysis::Block& block) {
      return std::holds_alternative<analysis::CaptionedFigure>(block);
    });
  return page;
}

void Write(const WalkComparison& comparison, analysis::Document page,
           const std::filesystem::path& folder) {
  core::CreateFolders(folder);
  page = analysis::DrawFigures(std::move(page), folder / "figures");
  core::WriteText(folder / "compare.json", analysis::JsonText(ComparisonJson(comparison)));
  core::WriteText(folder / "compare.html", analysis::ToHtml(page));
  fmt::print("{}\n", (folder / "compare.html").string());
}

}  // namespace

void AddCompare(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "two sets of walks, logs, runs or campaigns: what differs, by which evidence");
  const char* kSet = "a log, a folder of logs, a run, or a campaign's arm as FOLDER:ARM";
  command->add_option("first", o->a, kSet)->required();
  command->add_option("second", o->b, kSet)->required();
  command->add_option("-o,--out", o->out, "folder for compare.html, its figures and compare.json");
  command->add_option("--alpha", o->alpha, "of all metrics and distributions together")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 0.5));
  command->add_option("--robot", o->how.robot,
                      "of logs: robot YAML, or name of one of ours (default: as the log says)");
  command->add_option(
      "--mapping", o->how.rows.mapping,
      "of logs: mapping file, or name of a shipped one (default: the one that fits)");
  command->add_option("--msg-path", o->how.rows.msg_paths,
                      "folder of .msg or .idl files that define types; may be repeated");
  command->add_flag("--fail", o->fail, "exit code 1 if something differs");
  command->callback([o, &exit_code] {
    const bool by_logs = !IsResults(o->a) || !IsResults(o->b);
    const WalkComparison comparison =
        CompareWalks(LoadWalks(o->a, o->how, by_logs), LoadWalks(o->b, o->how, by_logs), o->alpha);
    const analysis::Document page = ComparisonDocument(comparison);
    fmt::print("{}", analysis::ToPlainText(WithoutFigures(page)));
    if (!o->out.empty()) Write(comparison, page, o->out);
    if (o->fail && ComparisonJson(comparison).at("different")) exit_code = kFailed;
  });
}

}  // namespace scoria::app
