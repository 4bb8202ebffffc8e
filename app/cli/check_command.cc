// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "app/check/check_files.h"
#include "app/check/run_checks.h"
#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/cli/progress.h"
#include "core/files.h"

namespace scoria::app {
namespace {

struct CheckArguments {
  std::vector<std::string> paths, set;
  std::string out = "out/check", junit, json, shard;
  int workers = 2;
  bool no_artifacts = false;
};

std::optional<int> ToNumber(std::string_view text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc{} && stop == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

std::optional<Shard> ToShard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto part = ToNumber(std::string_view(text).substr(0, slash));
  const auto of = ToNumber(std::string_view(text).substr(slash + 1));
  if (!part || !of || *part < 1 || *part > *of) return std::nullopt;
  return Shard{*part, *of};
}

std::string WrongShard(const std::string& text) {
  return ToShard(text) ? "" : fmt::format("\"{}\" is no part of a whole, as 2/4", text);
}

/// A line of the table, and one for each problem.
void PrintOutcome(const CheckOutcome& o, std::size_t name_width) {
  const char* status = o.status == CheckStatus::kPassed   ? "pass"
                       : o.status == CheckStatus::kFailed ? "FAIL"
                                                          : "ERROR";
  fmt::print("{:5}  {:{}}  {:7.1f} s  {} {}\n", status, o.test->name, name_width, o.wall_s,
             o.findings.size(), o.findings.size() == 1 ? "bound" : "bounds");
  for (const std::string& problem : ProblemsOf(o)) fmt::print("       {}\n", problem);
  std::fflush(stdout);
}

void PrintEnd(const CheckRun& run, std::size_t tests) {
  const auto count = [&](CheckStatus status) {
    return std::ranges::count(run.outcomes, status, &CheckOutcome::status);
  };
  for (const CheckOutcome& o : run.outcomes) {
    if (!o.artifacts.empty())
      fmt::print("{}: {}\n", o.test->name, o.artifacts.front().parent_path().string());
    if (!o.artifact_problem.empty()) Note(o.test->name + ": " + o.artifact_problem);
  }
  fmt::print("{} passed, {} failed, {} in error", count(CheckStatus::kPassed),
             count(CheckStatus::kFailed), count(CheckStatus::kError));
  if (run.outcomes.size() < tests) fmt::print(", {} not walked", tests - run.outcomes.size());
  fmt::print("\n");
  if (!run.disk_problem.empty()) Note(run.disk_problem);
}

int Check(const CheckArguments& o) {
  CheckSelection selection{{o.paths.begin(), o.paths.end()}, o.set, {}};
  if (!o.shard.empty()) selection.shard = *ToShard(o.shard);
  const FoundTests found = FindTests(selection);
  for (const std::string& other : found.not_tests) Note(other + ", no test");
  std::size_t width = 0;
  for (const CheckTest& test : found.tests) {
    width = std::max(width, test.name.size());
    for (const std::string& unfit : test.unfit)
      Note(fmt::format("{}: without --set {}, which it does not take", test.name, unfit));
  }
  CheckOptions options;
  options.folder = o.out;
  options.workers = o.workers;
  options.program = std::filesystem::read_symlink("/proc/self/exe").string();
  options.artifacts = !o.no_artifacts;
  options.interrupted = &Interrupted();
  ProgressBar bar("check");
  options.on_outcome = [&](const CheckOutcome& outcome) {
    bar.Clear();
    PrintOutcome(outcome, width);
  };
  options.on_progress = [&](int done, int of) {
    bar.Update(static_cast<double>(done) / of, fmt::format("{}/{} episodes", done, of));
  };
  const CheckRun run = RunChecks(found.tests, options);
  bar.Clear();
  if (!o.junit.empty()) core::WriteText(o.junit, ToJunit(run.outcomes));
  if (!o.json.empty()) core::WriteText(o.json, ToJsonText(run.outcomes));
  PrintEnd(run, found.tests.size());
  if (!run.disk_problem.empty()) return kFileError;
  if (run.interrupted) return kStopped;
  const auto passed = [](const CheckOutcome& c) { return c.status == CheckStatus::kPassed; };
  return std::ranges::all_of(run.outcomes, passed) ? kOk : kFailed;
}

}  // namespace

void AddCheck(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<CheckArguments>();
  CLI::App* check = app.add_subcommand(
      "check", "walk scenarios and campaigns as tests and judge them by what they expect");
  check->add_option("tests", o->paths, "folders, with all below them, and files")
      ->required()
      ->check(CLI::ExistingPath);
  check->add_option("-j,--workers", o->workers, "processes at a time")->check(CLI::Range(1, 1024));
  check->add_option("--set", o->set, "override a scenario's key in every test that has it");
  check->add_option("--out", o->out, "folder for a folder of each test (default out/check)");
  check->add_option("--junit", o->junit, "file for the outcomes as JUnit XML");
  check->add_option("--json", o->json, "file for the outcomes with every bound");
  check->add_option("--shard", o->shard, "a part of the tests, as 2/4")
      ->check(CLI::Validator(WrongShard, ""));
  check->add_flag("--no-artifacts", o->no_artifacts, "no log, clip and figure of failures");
  check->callback([o, &exit_code] { exit_code = Check(*o); });
}

}  // namespace scoria::app
