// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

bool HasLedger(const Cell& c) { return c.values.contains("ledger_motor_J"); }

std::optional<std::string> WhyNoEnergy(const ReportInput& input) {
  if (std::any_of(input.cells.begin(), input.cells.end(), HasLedger)) return std::nullopt;
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kLedger}))) return reason;
  return "no episode left numbers of the motors' work";
}

/// Where the motors' work went.
Blocks BuildEnergy(const ReportInput& input) {
  std::vector<Cell> cells = input.cells;
  std::erase_if(cells, [](const Cell& c) { return !HasLedger(c); });
  const Table lead = PointTable(input.results.axes, cells, std::array<Column<Cell>, 0>{});
  return {WithMetrics(lead, cells, MetricsOf(input.metrics, MetricFamily::kEnergy)),
          Note{"Net mechanical work on the robot; losses are negative. Stored is the change of "
               "kinetic and potential energy. What the works do not explain of it is the "
               "integrator's error."}};
}

}  // namespace

Section EnergySection() { return {"energy", "Energy ledger", WhyNoEnergy, BuildEnergy}; }

}  // namespace scoria::analysis
