// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/write_analysis.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "analysis/report/report.h"
#include "app/version.h"
#include "core/config/field.h"
#include "core/files.h"

namespace scoria::app {
namespace {

using analysis::AllMetrics;
using nlohmann::json;

json ToJson(const logs::Finding& f) {
  json spans = json::array(), spoils = json::array();
  for (const logs::TimeSpan& span : f.spans) spans.push_back({span.begin_s, span.end_s});
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (f.spoils[static_cast<std::size_t>(group)]) spoils.push_back(name);
  }
  return {{"severity", core::EnumName(f.severity)},
          {"kind", core::EnumName(f.kind)},
          {"signal", f.signal},
          {"leg", f.leg ? json(LegName(*f.leg)) : json(nullptr)},
          {"joint", f.joint ? json(static_cast<int>(*f.joint)) : json(nullptr)},
          {"spans_s", spans},
          {"count", f.count},
          {"size", f.size ? json(*f.size) : json(nullptr)},
          {"evidence", f.evidence},
          {"spoils", spoils},
          {"repair", f.repair}};
}

json NumbersOf(const analysis::EpisodeMetrics& metrics) {
  const analysis::Metrics all = AllMetrics();
  return analysis::ToJson(all, analysis::ValuesOf(all, metrics));
}

json ToJson(const LogAnalysis& analysis) {
  const analysis::FieldLog& log = analysis.log;
  json object = {{"id", log.id},
                 {"files", json::array()},
                 {"robot", log.robot},
                 {"mass", log.mass},
                 {"remarks", log.remarks},
                 {"accepted", log.accepted},
                 {"findings", json::array()},
                 {"metrics", log.metrics},
                 {"parts", json::array()},
                 {"cpu_power_W", nullptr},
                 {"truth_alignment", nullptr},
                 {"trajectory_error", nullptr}};
  object["metrics"]["scalars"] = NumbersOf(log.metrics);
  if (analysis.cpu_power_W) object["cpu_power_W"] = *analysis.cpu_power_W;
  if (analysis.truth_alignment) object["truth_alignment"] = *analysis.truth_alignment;
  if (analysis.trajectory_error) object["trajectory_error"] = *analysis.trajectory_error;
  for (const auto& file : log.files) object["files"].push_back(file.string());
  for (const logs::Finding& finding : log.findings) object["findings"].push_back(ToJson(finding));
  for (const WalkParts::Part& part : analysis.parts) {
    object["parts"].push_back({{"sequencer", part.sequencer},
                               {"command_mps", part.command_mps},
                               {"scalars", NumbersOf(part.metrics)}});
  }
  return object;
}

std::string SpeedText(double mps) { return fmt::format("{:.1f}", mps); }

/// The parts of all logs as a campaign: sequencers are its arms, commanded speeds its sweep.
analysis::CampaignResults PoolParts(const std::vector<LogAnalysis>& logs, const std::string& name) {
  analysis::CampaignResults results;
  results.name = name;
  std::set<std::string> sequencers;
  std::set<double> speeds_mps;
  std::uint64_t seed = 0;  // a ground of its own for each log
  for (const LogAnalysis& analysis : logs) {
    ++seed;
    results.logs.push_back(analysis.log);
    for (const WalkParts::Part& part : analysis.parts) {
      sequencers.insert(part.sequencer);
      speeds_mps.insert(part.command_mps);
      analysis::EpisodeRecord& e = results.episodes.emplace_back();
      e.arm = part.sequencer;
      e.point = {SpeedText(part.command_mps)};
      e.id = fmt::format("{}, {} at {} m/s", analysis.log.id, e.arm, e.point[0]);
      e.end = "completed";
      e.seed = seed;
      e.has_metrics = true;
      e.walked_m = part.metrics.distance_m;
      e.metrics = part.metrics;
      e.ground = analysis.log.id;
    }
  }
  results.arms.assign(sequencers.begin(), sequencers.end());
  analysis::Axis speed{"command_mps", "commanded speed [m/s]", {}, ""};
  for (const double mps : speeds_mps) speed.values.push_back(SpeedText(mps));
  results.axes = {speed};
  return results;
}

json PooledJson(const analysis::ReportInput& input) {
  json pooled = json::array();
  const auto add = [&](const analysis::Cell& cell, const json& speed) {
    if (cell.episodes == 0) return;
    pooled.push_back({{"sequencer", cell.arm},
                      {"command_mps", speed},
                      {"falls_per_m_low", cell.falls.interval.low},
                      {"falls_per_m_high", cell.falls.interval.high},
                      {"scalars", analysis::ToJson(input.metrics, cell.values)}});
  };
  for (const analysis::Cell& cell : input.pooled) add(cell, nullptr);
  for (const analysis::Cell& cell : input.cells) add(cell, std::stod(cell.point.at(0)));
  return pooled;
}

}  // namespace

std::filesystem::path WriteAnalysis(const std::vector<LogAnalysis>& logs, const std::string& name,
                                    const std::filesystem::path& folder) {
  const analysis::ReportInput input =
      analysis::MakeReportInput(folder, PoolParts(logs, name), std::nullopt);
  json all = {{"name", name},
              {"version", kVersion},
              {"logs", json::array()},
              {"pooled", PooledJson(input)}};
  for (const LogAnalysis& log : logs) all["logs"].push_back(ToJson(log));
  core::CreateFolders(folder);
  core::WriteText(folder / "analysis.json", analysis::JsonText(all));
  return analysis::WriteReport(input, folder / "report");
}

}  // namespace scoria::app
