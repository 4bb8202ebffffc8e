// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/optional_json.h"
#include "core/math/types.h"

namespace scoria::analysis {

using logs::RowGroup;
using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Energy, mech_abs_J, mech_pos_J, electrical_J, battery_J)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnergyBudget, motor_J, joint_J, contact_J, external_J, stored_J,
                                   error_J)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpeedWindow, v_mps, command_mps, cot_mech_abs, cot_mech_pos,
                                   cot_electrical)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrackingErrors, samples_s, velocity_rmse_mps, velocity_x_mps,
                                   velocity_y_mps, yaw_rate_radps, command_x_mps, command_y_mps,
                                   command_yaw_radps, height_rmse_m, roll_rmse_rad, pitch_rmse_rad,
                                   drift_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeQuantiles, median_s, p99_s, max_s, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measured, value, weight)

void to_json(json& j, const FallEvent& f) {
  j = {{"time_s", f.time_s}, {"cause", f.cause}};
  if (f.p_WB) j["p_WB_m"] = {f.p_WB->x(), f.p_WB->y()};
}

void from_json(const json& j, FallEvent& f) {
  j.at("time_s").get_to(f.time_s);
  j.at("cause").get_to(f.cause);
  if (j.contains("p_WB_m"))
    f.p_WB = Vec2(j.at("p_WB_m").at(0).get<double>(), j.at("p_WB_m").at(1).get<double>());
}

void to_json(json& j, const LegTiming& t) {
  j = {{"strides", json::array()},
       {"phase", {t.phase.real(), t.phase.imag()}},
       {"phases", t.phases}};
  for (const auto& [number, bin] : t.bins)
    j["strides"].push_back({number, bin.count, bin.stride_s, bin.stance_s});
}

void from_json(const json& j, LegTiming& t) {
  for (const json& bin : j.at("strides")) {
    t.bins[bin.at(0).get<int>()] = {bin.at(1).get<std::uint64_t>(), bin.at(2).get<double>(),
                                    bin.at(3).get<double>()};
  }
  t.phase = {j.at("phase").at(0).get<double>(), j.at("phase").at(1).get<double>()};
  j.at("phases").get_to(t.phases);
}

namespace {

json ToJson(const logs::RowGroups& groups) {
  json names = json::array();
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    if (groups[static_cast<std::size_t>(group)]) names.push_back(name);
  }
  return names;
}

/// Names of other versions' groups are passed over.
logs::RowGroups ToGroups(const json& names) {
  logs::RowGroups groups;
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    const bool had = std::find(names.begin(), names.end(), name) != names.end();
    groups[static_cast<std::size_t>(group)] = had;
  }
  return groups;
}

/// The value, or null where no row had the group.
template <class T>
json If(bool measured, const T& value) {
  return measured ? json(value) : json(nullptr);
}

/// Leaves `value` as it is where there is null.
template <class T>
void Read(const json& j, const char* key, T& value) {
  if (const json& found = j.at(key); !found.is_null()) found.get_to(value);
}

/// In results that do not say which groups their rows had, zero stands for nothing.
void DropZeros(EpisodeMetrics& m) {
  TrackingErrors& t = m.tracking;
  for (std::optional<double>* value :
       {&m.mass_kg, &m.peak_foot_force_N, &t.velocity_rmse_mps, &t.height_rmse_m, &t.roll_rmse_rad,
        &t.pitch_rmse_rad, &t.drift_m}) {
    if (*value == 0.0) value->reset();
  }
  if (m.cot && m.cot->mech_abs == 0.0 && m.cot->electrical == 0.0) m.cot.reset();
}

json ToJson(const GaitTiming& gait) {
  json legs = json::array();
  for (const LegTiming& leg : gait.legs) legs.push_back(leg);
  return legs;
}

json SubstitutesToJson(const Substitutes& substitutes) {
  json object = json::object();
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    const auto source = substitutes.find(group);
    if (source != substitutes.end()) object[std::string(name)] = source->second;
  }
  return object;
}

/// What came with the times of the gait.
void ReadGait(const json& j, EpisodeMetrics& m) {
  for (const Leg leg : kLegs)
    j.at("gait").at(static_cast<std::size_t>(leg)).get_to(m.gait.legs[leg]);
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    const json& all = j.at("substitutes");
    if (const auto source = all.find(name); source != all.end())
      m.substitutes[group] = source->get<std::string>();
  }
  for (const auto& [key, reason] : j.at("withheld").items())
    m.withheld[key] = reason.get<std::string>();
}

void ReadCost(const json& j, std::optional<CostOfTransport>& cot) {
  if (j.at("cot_mech_abs").is_null()) return;
  cot.emplace();
  j.at("cot_mech_abs").get_to(cot->mech_abs);
  j.at("cot_mech_pos").get_to(cot->mech_pos);
  j.at("cot_electrical").get_to(cot->electrical);
  j.at("cot_battery").get_to(cot->battery);
}

}  // namespace

void to_json(json& j, const EpisodeMetrics& m) {
  const auto had = [&](RowGroup group) {
    return !m.groups || (*m.groups)[static_cast<std::size_t>(group)] ||
           m.substitutes.contains(group);
  };
  const auto cost = [&](double CostOfTransport::*kind) {
    return m.cot ? json((*m.cot).*kind) : json(nullptr);
  };
  j = {{"duration_s", m.duration_s},
       {"walking_s", If(had(RowGroup::kEpisode), m.walking_s)},
       {"distance_m", If(had(RowGroup::kTruth), m.distance_m)},
       {"mass_kg", m.mass_kg},
       {"transport_J", If(had(RowGroup::kTruth) && had(RowGroup::kTrueMass), m.transport_J)},
       {"energy", If(had(RowGroup::kEnergy), m.energy)},
       {"cot_mech_abs", cost(&CostOfTransport::mech_abs)},
       {"cot_mech_pos", cost(&CostOfTransport::mech_pos)},
       {"cot_electrical", cost(&CostOfTransport::electrical)},
       {"cot_battery", cost(&CostOfTransport::battery)},
       {"budget", If(had(RowGroup::kLedger), m.budget)},
       {"windows", m.windows},
       {"tracking", If(m.tracking.samples_s > 0.0, m.tracking)},
       {"mpc", If(m.mpc.count > 0, m.mpc)},
       {"wbc", If(m.wbc.count > 0, m.wbc)},
       {"falls", m.falls},
       {"first_fall_m", If(had(RowGroup::kTruth), m.first_fall_m)},
       {"peak_foot_force_N", m.peak_foot_force_N},
       {"estimation", m.estimation},
       {"model", m.model},
       {"gait", ToJson(m.gait)},
       {"substitutes", SubstitutesToJson(m.substitutes)},
       {"withheld", m.withheld},
       {"measured", m.measured}};
  if (m.groups) j["groups"] = ToJson(*m.groups);
}

void from_json(const json& j, EpisodeMetrics& m) {
  j.at("duration_s").get_to(m.duration_s);
  Read(j, "walking_s", m.walking_s);
  Read(j, "distance_m", m.distance_m);
  Read(j, "mass_kg", m.mass_kg);
  Read(j, "energy", m.energy);
  ReadCost(j, m.cot);
  Read(j, "budget", m.budget);
  j.at("windows").get_to(m.windows);
  Read(j, "tracking", m.tracking);
  Read(j, "mpc", m.mpc);
  Read(j, "wbc", m.wbc);
  j.at("falls").get_to(m.falls);
  Read(j, "peak_foot_force_N", m.peak_foot_force_N);
  // What follows older results lack.
  if (j.contains("transport_J")) Read(j, "transport_J", m.transport_J);
  if (j.contains("first_fall_m")) Read(j, "first_fall_m", m.first_fall_m);
  if (j.contains("measured")) j.at("measured").get_to(m.measured);
  if (j.contains("groups")) m.groups = ToGroups(j.at("groups"));
  if (!m.groups) DropZeros(m);
  if (j.contains("gait")) ReadGait(j, m);
  m.estimation = j.value("estimation", EstimationMetrics{});
  m.model = j.value("model", ModelMetrics{});
}

}  // namespace scoria::analysis
