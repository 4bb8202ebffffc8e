// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

std::optional<std::string> WhyNoData(const ReportInput& /*input*/) { return std::nullopt; }

Blocks BuildData(const ReportInput& /*input*/) {
  return {
      Note{"Definitions of every number: docs/METRICS.md. Data: metrics.csv (episodes), "
           "metrics.json (cells, comparisons); figures with their gnuplot scripts: figures/."}};
}

}  // namespace

Section DataSection() { return {"data", "Definitions and data", WhyNoData, BuildData}; }

}  // namespace scoria::analysis
