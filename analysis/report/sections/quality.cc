// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "core/config/field.h"

namespace scoria::analysis {
namespace {

std::optional<std::string> WhyNoQuality(const ReportInput& /*input*/) { return std::nullopt; }

std::string Where(const logs::Finding& finding) {
  constexpr std::array<const char*, kJointsPerLeg> kJoints = {"HAA", "HFE", "KFE"};
  std::string where = finding.signal;
  if (finding.leg) where += fmt::format(" {}", LegName(*finding.leg));
  if (finding.joint)
    where += fmt::format(" {}", kJoints.at(static_cast<std::size_t>(*finding.joint)));
  return where;
}

/// The longest span, and how many there are.
std::string When(const logs::Finding& finding) {
  if (finding.spans.empty()) return "all of it";
  const auto longest = std::max_element(
      finding.spans.begin(), finding.spans.end(),
      [](const auto& a, const auto& b) { return a.end_s - a.begin_s < b.end_s - b.begin_s; });
  const std::string first = fmt::format("{:.3f} to {:.3f} s", longest->begin_s, longest->end_s);
  return finding.count > 1 ? fmt::format("{} times, {} the longest", finding.count, first) : first;
}

/// The groups that a stand-in may be made of.
logs::RowGroups MadeOf(logs::RowGroup stand_in) {
  using logs::RowGroup;
  switch (stand_in) {
    case RowGroup::kTruth:
      return Groups({RowGroup::kEstimate, RowGroup::kMeasured, RowGroup::kContacts});
    case RowGroup::kEnergy:
      return Groups({RowGroup::kMeasured});
    case RowGroup::kTrueContacts:
      return Groups({RowGroup::kContacts, RowGroup::kMeasured});
    default:
      return {};
  }
}

/// The metrics that were computed and need a group that the finding spoils.
std::string Spoiled(const logs::Finding& finding, const FieldLog& log, const Metrics& metrics) {
  std::string titles;
  int more = 0, named = 0;
  for (const Metric& metric : metrics) {
    logs::RowGroups sources = metric.info.needs;
    for (const auto& [group, source] : log.metrics.substitutes) {
      if (metric.info.takes_substitutes && sources[static_cast<std::size_t>(group)])
        sources |= MadeOf(group);
    }
    if ((sources & finding.spoils).none() || !ValueOf(metric, log.metrics)) continue;
    constexpr int kNamed = 6;
    if (++named > kNamed) {
      ++more;
      continue;
    }
    titles += fmt::format("{}{}", titles.empty() ? "" : ", ", metric.info.title);
  }
  if (more > 0) titles += fmt::format(" and {} more", more);
  return titles.empty() ? "none" : titles;
}

Blocks BuildQuality(const ReportInput& input) {
  Blocks blocks;
  for (const FieldLog& log : input.results.logs) {
    if (input.results.logs.size() > 1) blocks.push_back(Heading{log.id});
    if (!log.accepted.empty()) blocks.push_back(BulletList{log.accepted});
    if (log.findings.empty()) {
      blocks.push_back(Paragraph{"No finding."});
      continue;
    }
    Table table{{"severity", "finding", "of", "when", "evidence", "spoils", "what to do"}, {}};
    for (const logs::Finding& f : log.findings) {
      table.rows.push_back({std::string(core::EnumName(f.severity)),
                            std::string(core::EnumName(f.kind)), Where(f), When(f), f.evidence,
                            Spoiled(f, log, input.metrics), f.repair});
    }
    blocks.push_back(table);
  }
  blocks.push_back(
      Note{"An error: what it spoils is wrong. A warning: some of the log is lost, or numbers are "
           "less exact. Nothing was repaired or left out but what is said to be accepted; rows on "
           "both sides of a gap are not one walk. Kinds: docs/log_quality.md."});
  return blocks;
}

}  // namespace

Section QualitySection() { return {"quality", "Quality of the logs", WhyNoQuality, BuildQuality}; }

}  // namespace scoria::analysis
