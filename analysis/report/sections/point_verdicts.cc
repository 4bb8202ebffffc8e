// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/head.h"
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

std::optional<std::string> WhyNoPointVerdicts(const ReportInput& input) {
  if (input.results.arms.size() < 2) return "there is one arm, and none to compare it with";
  if (input.results.design) return "the points of a design are pooled";
  if (input.results.axes.empty()) return "the arms walked no sweep";
  return std::nullopt;
}

Blocks BuildPointVerdicts(const ReportInput& input) {
  BulletList verdicts;
  for (const Comparison& c : input.comparisons) {
    if (!c.point.empty()) verdicts.items.push_back(c.verdict);
  }
  return {verdicts, VerdictNote()};
}

}  // namespace

Section PointVerdictsSection() {
  return {"point_verdicts", "Who falls less, at each point", WhyNoPointVerdicts,
          BuildPointVerdicts};
}

}  // namespace scoria::analysis
