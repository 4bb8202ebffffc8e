// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"

namespace scoria::analysis {
namespace {

template <class T>
void Append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Energy& Energy::operator+=(const Energy& other) noexcept {
  mech_abs_J += other.mech_abs_J;
  mech_pos_J += other.mech_pos_J;
  electrical_J += other.electrical_J;
  battery_J += other.battery_J;
  return *this;
}

Energy operator-(const Energy& a, const Energy& b) noexcept {
  return {a.mech_abs_J - b.mech_abs_J, a.mech_pos_J - b.mech_pos_J, a.electrical_J - b.electrical_J,
          a.battery_J - b.battery_J};
}

EnergyBudget& EnergyBudget::operator+=(const EnergyBudget& other) noexcept {
  motor_J += other.motor_J;
  joint_J += other.joint_J;
  contact_J += other.contact_J;
  external_J += other.external_J;
  stored_J += other.stored_J;
  error_J += other.error_J;
  return *this;
}

EpisodeMetrics& EpisodeMetrics::operator+=(const EpisodeMetrics& other) {
  episodes += other.episodes;
  groups = groups && other.groups ? std::optional(*groups | *other.groups) : std::nullopt;
  for (const auto& [group, source] : other.substitutes) {
    std::string& own = substitutes[group];
    if (own.find(source) == std::string::npos) own += (own.empty() ? "" : "; ") + source;
  }
  withheld.insert(other.withheld.begin(), other.withheld.end());
  if (outcome && other.outcome) {
    outcome->falls += other.outcome->falls;
  } else if (other.outcome) {
    outcome = other.outcome;
  }
  distance_m += other.distance_m;
  transport_J += other.transport_J;
  energy += other.energy;
  budget += other.budget;
  cot = CalcCostOfTransport(*this);
  Append(falls, other.falls);
  estimation += other.estimation;
  model.present = model.present || other.model.present;
  Append(model.intervals, other.model.intervals);
  gait += other.gait;
  return *this;
}

std::optional<CostOfTransport> CalcCostOfTransport(const EpisodeMetrics& m) noexcept {
  if (m.transport_J <= 0.0 || m.distance_m <= kLeastWay_m * m.episodes) return std::nullopt;
  return CostOfTransport{m.energy.mech_abs_J / m.transport_J, m.energy.mech_pos_J / m.transport_J,
                         m.energy.electrical_J / m.transport_J, m.energy.battery_J / m.transport_J};
}

}  // namespace scoria::analysis
