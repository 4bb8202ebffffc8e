// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "app/analyze/experiment.h"
#include "app/analyze/write_analysis.h"
#include "app/cli/commands.h"
#include "app/cli/progress.h"
#include "core/config/field.h"

namespace scoria::app {
namespace {

struct AnalyzeArguments {
  std::vector<std::filesystem::path> logs;
  std::filesystem::path out, labels;
  AnalyzeOptions how;
  bool quiet = false;
};

void Print(const LogAnalysis& analysis) {
  const analysis::FieldLog& log = analysis.log;
  fmt::print("{}\n  robot         {}\n  mass          {}\n", log.id, log.robot, log.mass);
  for (const std::string& remark : log.remarks) fmt::print("  {}\n", remark);
  for (const std::string& accepted : log.accepted) fmt::print("  {}\n", accepted);
  for (const logs::Finding& finding : log.findings)
    fmt::print("  {}\n", logs::DescribeFinding(finding));
  for (const auto& [group, source] : log.metrics.substitutes)
    fmt::print("  {}: {}\n", core::EnumName(group), source);
  for (const analysis::FallEvent& fall : log.metrics.falls)
    fmt::print("  fall at {:.2f} s, told by {}\n", fall.time_s, fall.cause);
  fmt::print("{}", analysis::DescribeMetrics(analysis::AllMetrics(), log.metrics));
  if (analysis.cpu_power_W) fmt::print("  CPU power {:.1f} W\n", *analysis.cpu_power_W);
}

std::vector<LogAnalysis> AnalyzeAll(const AnalyzeArguments& o) {
  std::vector<LogAnalysis> all;
  const std::vector<LogEntry> entries = ListLogs(o.logs);
  ProgressBar bar("analyze");
  for (const LogEntry& entry : entries) {
    bar.Update(static_cast<double>(all.size()) / static_cast<double>(entries.size()), entry.id);
    LogAnalysis analysis = AnalyzeLog(entry.files, entry.id, entry.robot_hint, o.how);
    analysis.log.remarks.insert(analysis.log.remarks.end(), entry.remarks.begin(),
                                entry.remarks.end());
    all.push_back(std::move(analysis));
  }
  return all;
}

}  // namespace

void AddAnalyze(CLI::App& app) {
  auto o = std::make_shared<AnalyzeArguments>();
  CLI::App* command =
      app.add_subcommand("analyze", "judge logs of robots, and compute what their signals allow");
  command
      ->add_option("logs", o->logs,
                   "logs (files, folders of bags), experiment folders; CSV files are one log")
      ->required();
  command->add_option("-o,--out", o->out, "folder for analysis.json and the report")->required();
  command->add_option("--robot", o->how.robot,
                      "robot YAML, or name of one of ours (default: as the log or mapping says)");
  command->add_option("--mapping", o->how.rows.mapping,
                      "mapping file, or name of a shipped one (default: the one that fits)");
  command->add_option("--mass", o->how.mass_kg, "of the whole robot with its payload [kg]")
      ->check(CLI::PositiveNumber);
  command->add_option("--gravity", o->how.gravity_mps2, "where it walked [m/s^2] (default 9.81)")
      ->check(CLI::PositiveNumber);
  command->add_option("--accept", o->how.accept,
                      "kind of a finding to be repaired, or its time left out; may be repeated");
  command->add_option("--labels", o->labels,
                      "CSV: time, and fall, not a fall or operator stop (and the log's name)");
  command->add_option("--msg-path", o->how.rows.msg_paths,
                      "folder of .msg or .idl files that define types; may be repeated");
  command->add_flag("--quiet", o->quiet, "print nothing but the report's path");
  command->callback([o] {
    if (!o->labels.empty()) o->how.labels = ReadLabels(o->labels);
    const std::vector<LogAnalysis> all = AnalyzeAll(*o);
    if (!o->quiet) {
      for (const LogAnalysis& analysis : all) Print(analysis);
    }
    const std::string name = all.size() == 1 ? all[0].log.id : fmt::format("{} logs", all.size());
    fmt::print("{}\n", WriteAnalysis(all, name, o->out).string());
  });
}

}  // namespace scoria::app
