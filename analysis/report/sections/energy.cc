// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

bool HasLedger(const Cell& c) { return c.budget.motor_J != 0.0; }

constexpr std::array<Column<Cell>, 6> kColumns = {{
    {"motors [J]", [](const Cell& c) { return NumberText(c.budget.motor_J, 0); }},
    {"outside [J]", [](const Cell& c) { return NumberText(c.budget.external_J, 0); }},
    {"joints [J]", [](const Cell& c) { return NumberText(c.budget.joint_J, 0); }},
    {"ground [J]", [](const Cell& c) { return NumberText(c.budget.contact_J, 0); }},
    {"stored [J]", [](const Cell& c) { return NumberText(c.budget.stored_J, 0); }},
    {"unexplained [% of motors]",
     [](const Cell& c) {
       return NumberText(100.0 * c.budget.error_J / std::abs(c.budget.motor_J), 2);
     }},
}};

std::optional<std::string> WhyNot(const ReportInput& input) {
  if (std::any_of(input.cells.begin(), input.cells.end(), HasLedger)) return std::nullopt;
  return "no episode left numbers of the motors' work";
}

/// Where the motors' work went.
Blocks Build(const ReportInput& input) {
  std::vector<Cell> cells = input.cells;
  std::erase_if(cells, [](const Cell& c) { return !HasLedger(c); });
  return {PointTable(input.results.axes, cells, kColumns),
          Note{"Net mechanical work on the robot; losses are negative. Stored is the change of "
               "kinetic and potential energy. What the works do not explain of it is the "
               "integrator's error."}};
}

}  // namespace

Section EnergySection() { return {"energy", "Energy ledger", WhyNot, Build}; }

}  // namespace scoria::analysis
