// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

/// Where the motors did nothing, there is no ledger.
template <double EnergyBudget::*value>
std::optional<Measured> Work(const EpisodeMetrics& m) {
  return MeasuredIf(m.budget.motor_J != 0.0, m.budget.*value);
}

std::optional<Measured> ErrorShare(const EpisodeMetrics& m) {
  if (m.budget.motor_J == 0.0) return std::nullopt;
  return Measured{m.budget.error_J / std::abs(m.budget.motor_J)};
}

MetricInfo WorkInfo(std::string_view key, std::string_view title, std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kEnergy,
          .symbol = "W",
          .unit = "J",
          .title = title,
          .digits = 0,
          .needs = Groups({logs::RowGroup::kEpisode, logs::RowGroup::kLedger}),
          .pooling = Pooling::kSum,
          .definition = definition};
}

MetricInfo ErrorInfo() {
  MetricInfo info = WorkInfo("ledger_error_share", "energy unexplained",
                             "What the integrator made or lost of the energy, of the motors' net "
                             "work.");
  info.symbol = "";
  info.unit = "";
  info.shown_unit = "% of motors";
  info.scale = 100.0;
  info.digits = 2;
  info.better = Better::kLower;
  info.pooling = Pooling::kAccumulated;
  info.pooled_over = "ratio of sums";
  return info;
}

}  // namespace

Metrics EnergyMetrics() {
  using B = EnergyBudget;
  return {
      {WorkInfo("ledger_motor_J", "work of the motors", "Net work of the motors."),
       Work<&B::motor_J>},
      {WorkInfo("ledger_external_J", "work from outside",
                "Net work of pushes and of who placed loads."),
       Work<&B::external_J>},
      {WorkInfo("ledger_joint_J", "work of the joints",
                "Net work of the joints' friction, damping and limits."),
       Work<&B::joint_J>},
      {WorkInfo("ledger_contact_J", "work of the ground", "Net work of the ground on the robot."),
       Work<&B::contact_J>},
      {WorkInfo("ledger_stored_J", "energy stored", "Change of kinetic and potential energy."),
       Work<&B::stored_J>},
      {ErrorInfo(), ErrorShare}};
}

}  // namespace scoria::analysis
